#include "dashpot/damper/inverse/inverse_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/observer.h"
#include "dashpot/damper/inverse/random_signal.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr double kDuration = 15;  // s of each test

/// Band-limited noise of motion and current.
BenchTest noise_test(const MotionRange& range, const InverseLimits& limits, std::uint64_t seed) {
  constexpr double kCurrentBand = 10;    // Hz
  constexpr double kCurrentShare = 0.7;  // the deviation, of half the range: the ends are met often
  Random random(seed);
  const auto motion = std::make_shared<RandomSignal>(random, 0, range.frequency);
  const auto drive = std::make_shared<RandomSignal>(random, 0, kCurrentBand);

  const double sigma = range.amplitude / 2, low = limits.current_min;
  const double half = 0.5 * (limits.current_max - limits.current_min);

  BenchTest test;
  test.name = test.condition = "noise";
  test.motion.duration = kDuration;
  test.motion.at = [=](double t) {
    return MotionPoint{sigma * motion->at(t), sigma * motion->derivative(t)};
  };
  test.drive.at = [=](double t) {
    return low + half * std::clamp(1 + kCurrentShare * drive->at(t), 0.0, 2.0);
  };
  return test;
}

std::string number_of(std::string_view name, double value) {
  return "," + std::string(name) + "=" + format_number(value);
}

}  // namespace

double MotionRange::speed() const {
  // Noise up to f has the deviation 2 pi f / sqrt(3) of its own; it hardly exceeds two and a half
  // of them.
  return 2.5 * (amplitude / 2) * 2 * std::numbers::pi * frequency / std::numbers::sqrt3;
}

std::vector<BenchTest> teaching_tests(const MotionRange& range, const InverseLimits& limits,
                                      std::uint64_t seed) {
  const std::string size =
      number_of("amplitude", range.amplitude) + number_of("speed_max", range.speed());
  const std::string band =
      number_of("frequency_max", 2 * range.frequency) + number_of("duration", kDuration);
  const DriveFrame frame{limits.current_min, limits.current_max, kDuration, seed};
  return {noise_test(range, limits, seed),
          under_sequence(sequence_test("RP" + size + band, seed), "ICPS", frame),
          under_sequence(sequence_test("FM" + size + band, seed), "APRBS", frame),
          under_sequence(
              sequence_test("TPNVS" + size + number_of("speed_min", range.speed() / 10), seed),
              "APRBS", frame)};
}

InverseRun run_on_model(const DamperModel& forward, const std::string& name,
                        const std::vector<DamperInput>& inputs, const InverseLimits& limits) {
  const Observer observer(forward, {limits.current_min, limits.current_max, limits.sample_time, 0});
  const double nudge = 0.05 * (limits.current_max - limits.current_min);
  InverseRun run{
      .name = name, .sample_time = limits.sample_time, .inputs = inputs, .force = {}, .weight = {}};
  std::vector<double> state(observer.state_size());
  observer.rest(inputs.front(), state);

  for (std::size_t k = 0; k < inputs.size(); ++k) {
    // Bring the model's states to this sample.
    const auto& [x, v, i] = inputs[k];
    const InverseInput now{0, x, v, i, 0};
    if (k > 0) observer.follow(now, state);

    // Slope of the force over the current: between two currents on either side of the present one,
    // both within the limits.
    const double least = std::max(i - nudge, limits.current_min);
    const double most = std::max(std::min(i + nudge, limits.current_max), least + nudge);
    const double slope =
        (observer.force(most, now, state) - observer.force(least, now, state)) / (most - least);

    run.force.push_back(observer.force(i, now, state));
    run.weight.push_back(slope * slope);
    if (!std::isfinite(run.force.back() + run.weight.back()))
      throw Error(forward.name(), "diverges on the motion '" + name + "'");
  }
  return run;
}

InverseRun run_on_model(const DamperModel& forward, const BenchTest& test,
                        const InverseLimits& limits) {
  std::vector<DamperInput> inputs;
  const auto samples = static_cast<std::size_t>(test.motion.duration / limits.sample_time);
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) * limits.sample_time;
    const auto [x, v] = test.motion.at(t);
    inputs.push_back({x, v, std::clamp(test.drive.at(t), limits.current_min, limits.current_max)});
  }
  return run_on_model(forward, test.name, inputs, limits);
}

}  // namespace dashpot
