#include "studies/suspension/study_dampers.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/bench_experiments.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/dampers/passive_curve.h"
#include "studies/one_sensor/one_sensor_fit.h"

namespace dashpot {
namespace {

std::vector<Record> recorded(const DamperModel& damper, const std::vector<BenchTest>& tests,
                             std::uint64_t seed) {
  BenchOptions bench = one_sensor_bench({});
  bench.seed = seed;
  return run_virtual_bench(damper, DriveUnit::Ampere, tests, bench).records;
}

/// A model without memory that is asked within some velocities only. Beyond them its force goes on
/// with the mean slope of the outermost fifth, as that of open valves does, and never falls.
class StraightOn final : public DamperModel {
 public:
  StraightOn(std::unique_ptr<DamperModel> inside, double fastest)
      : inside_(std::move(inside)), fastest_(fastest) {}

  ModelKind kind() const override { return ModelKind::Other; }
  std::string name() const override { return inside_->name(); }
  bool needs_displacement() const noexcept override { return inside_->needs_displacement(); }
  std::size_t parameter_count() const noexcept override { return inside_->parameter_count(); }
  std::size_t state_size() const noexcept override { return 0; }
  void rest(const DamperInput&, std::span<double>) const noexcept override {}
  void advance(const DamperInput&, const DamperInput&, double,
               std::span<double>) const noexcept override {}
  double force(const DamperInput& input, std::span<const double>) const noexcept override {
    const auto at = [&](double velocity) {
      DamperInput there = input;
      there.velocity = velocity;
      return inside_->force(there, {});
    };
    const double end = std::copysign(fastest_, input.velocity), before = 0.8 * end;
    if (std::abs(input.velocity) <= fastest_) return at(input.velocity);
    const double slope = std::max(0.0, (at(end) - at(before)) / (end - before));
    return at(end) + slope * (input.velocity - end);
  }
  std::unique_ptr<DamperModel> with_offset(double newton) const override {
    return std::make_unique<StraightOn>(inside_->with_offset(newton), fastest_);
  }
  Value to_json() const override { return inside_->to_json(); }

 private:
  std::shared_ptr<const DamperModel> inside_;
  double fastest_;  // m/s
};

double fastest_of(const std::vector<Record>& records) {
  double fastest = 0;
  for (const Record& record : records)
    for (const double v : record.channel("velocity").samples)
      fastest = std::max(fastest, std::abs(v));
  return fastest;
}

/// Fitted on the fold's training, judged on the rest.
NetworkDamper identified(std::string name, std::string description, const Fold& fold,
                         std::uint64_t seed) {
  // The paper's network as the one-sensor study fits it.
  const std::vector<StudiedModel> models = one_sensor_models();
  const auto wanted = std::ranges::find(models, kStatic, &StudiedModel::key);
  IdentifyOptions options;
  options.seed = seed;
  options.threads = 1;
  const StudiedFit fit = studied_fit(*wanted, fold.training, options);
  const FitReport report = identify(wanted->model, fit.training, DriveUnit::Ampere, fit.options);
  const StudiedResult result = judge(report, fold, DriveUnit::Ampere);

  // The span of the forces that judge it.
  double low = INFINITY, high = -INFINITY;
  for (const Record& record : fold.left_out) {
    const auto [least, greatest] = std::ranges::minmax_element(record.channel("force").samples);
    low = std::min(low, *least);
    high = std::max(high, *greatest);
  }

  // The force that it shows at rest without current is taken off.
  const double fastest = fastest_of(fold.training);
  return {.name = std::move(name),
          .description = std::move(description),
          .model = std::make_shared<StraightOn>(
              report.model->with_offset(-report.model->force({}, {})), fastest),
          .fastest = fastest,
          .quality = result.metrics,
          .half_span = (high - low) / 2};
}

std::vector<BenchTest> passive_tests(bool second, std::uint64_t seed) {
  std::vector<BenchTest> tests;
  // The two that cover all velocities at a constant current.
  for (const BenchExperiment& experiment : bench_experiments().first(2)) {
    std::string motion(experiment.switched.motion);
    if (second && !experiment.second.empty()) motion.append(",").append(experiment.second);
    tests.push_back(at_level(sequence_test(motion, seed), 0, DriveUnit::Ampere));
  }
  return tests;
}

}  // namespace

NetworkDamper identified_mr2(std::uint64_t seed) {
  const ParameterSet set = load_parameter_set("mr2");
  const auto tests = [&](Recording which) {
    return experiment_tests("one-sensor", set, seed, which);
  };
  const Fold fold{.name = set.name,
                  .training = recorded(set.model, tests(Recording::First), 2 * seed),
                  .left_out = recorded(set.model, tests(Recording::Second), 2 * seed + 1)};
  return identified("MR2", set.damper, fold, seed);
}

NetworkDamper identified_passive(double damping, std::uint64_t seed) {
  // The factor that makes the curve damp as asked.
  const PassiveCurve curve = load_passive_curve("suv_front");
  constexpr double kAmplitude = 0.02, kSpeed = 1;  // m, m/s: the paper's chirp at resonance, about
  const double factor = damping / equivalent_damping(curve, 0, kAmplitude, kSpeed);

  // The scaled curve as a table over the bench's velocities.
  constexpr double kFastest = 1.6;  // m/s
  constexpr int kPoints = 64;
  std::vector<double> velocity, force;
  for (int k = -kPoints; k <= kPoints; ++k) {
    velocity.push_back(kFastest * k / kPoints);
    force.push_back(factor * curve.force({0, velocity.back(), 0}, {}));
  }
  const PassiveCurve scaled("suv_front, scaled", velocity, force);

  // Recorded twice, like MR2, and identified by the same network.
  const Fold fold{.name = scaled.name(),
                  .training = recorded(scaled, passive_tests(false, seed), 2 * seed),
                  .left_out = recorded(scaled, passive_tests(true, seed + 1000), 2 * seed + 1)};
  return identified("passive",
                    "front damper of a large passenger car, forces times " +
                        format_number(factor, 3) + ": it damps like " + format_number(damping) +
                        " N*s/m along a sine of 20 mm at 1 m/s",
                    fold, seed);
}

}  // namespace dashpot
