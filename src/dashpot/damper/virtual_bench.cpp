#include "dashpot/damper/virtual_bench.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/differentiate.h"

namespace dashpot {
namespace {

constexpr double kInnerStep =
    1e-4;  // s, at most: fine enough that the motion between is a straight line

DamperInput piston(const BenchTest& test, double t) {
  const MotionPoint point = test.motion.at(t);
  return {point.displacement, point.velocity, test.drive.at(t)};
}

/// True motion, drive and force at the samples.
struct Truth {
  std::vector<double> time, displacement, velocity, force, drive;
};

/// The piston starts at rest, so that a free run from rest is exact from the first sample.
Truth simulate(const DamperModel& damper, const BenchTest& test, const BenchOptions& options) {
  const double dt = 1 / options.sample_rate;
  const auto samples = static_cast<std::size_t>(std::llround(test.motion.duration / dt)) + 1;
  const auto inner = static_cast<std::size_t>(std::ceil(dt / kInnerStep));
  const double h = dt / static_cast<double>(inner);
  DamperInput now = piston(test, 0);
  std::vector<double> state(damper.state_size());
  damper.rest(now, state);

  // Take a sample, then bring the damper to the next one in smaller steps.
  Truth truth;
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) * dt;
    truth.time.push_back(t);
    truth.displacement.push_back(now.displacement);
    truth.velocity.push_back(now.velocity);
    truth.drive.push_back(now.current);
    truth.force.push_back(damper.force(now, state));
    for (std::size_t step = 1; step <= inner; ++step) {
      const DamperInput next = piston(test, t + static_cast<double>(step) * h);
      damper.advance(now, next, h, state);
      now = next;
    }
  }
  return truth;
}

/// The readings of a sensor with this zero, noise and converter.
std::vector<double> measure(std::vector<double> values, double zero, double noise,
                            double resolution, Random& random) {
  for (double& value : values) {
    value += zero + noise * random.normal();
    if (resolution > 0) value = resolution * std::round(value / resolution);
  }
  return values;
}

double span(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

/// Without noise no random number is drawn, so that the sensor changes nothing else.
Channel measured_velocity(std::vector<double> velocity, double noise, Random& random) {
  if (noise > 0) velocity = measure(std::move(velocity), 0, noise, 0, random);
  return {"velocity", "m/s", std::move(velocity), "simulated sensor"};
}

/// The velocity as a reader would derive it from the measured displacement.
Channel derived_velocity(const std::vector<double>& displacement, double dt) {
  Derivative velocity = smooth_derivative(displacement, dt);
  return {"velocity", "m/s", std::move(velocity.slope),
          "derived from displacement, " + format_number(velocity.cutoff_hz) + " Hz zero-phase"};
}

Record run_test(const DamperModel& damper, const BenchTest& test, DriveUnit drive_unit,
                const BenchOptions& options, Random& random) {
  Truth truth = simulate(damper, test, options);
  const double offset = options.force_offset * random.normal();
  const double dt = 1 / options.sample_rate;
  std::vector<double> displacement = measure(truth.displacement, 0, options.displacement_noise,
                                             options.displacement_resolution, random);
  std::vector<double> force = measure(truth.force, offset, options.force_noise * span(truth.force),
                                      options.force_resolution, random);
  Channel velocity = options.velocity_sensor ? measured_velocity(std::move(truth.velocity),
                                                                 options.velocity_noise, random)
                                             : derived_velocity(displacement, dt);

  Record record;
  record.name = test.name;
  record.condition = test.condition;
  record.source = "virtual bench";
  record.drive_level = test.level;
  record.time = std::move(truth.time);
  record.sample_time = dt;
  record.channels.push_back({"displacement", "m", std::move(displacement), "simulated sensor"});
  record.channels.push_back(std::move(velocity));
  record.channels.push_back({"force", "N", std::move(force), "simulated load cell"});
  record.channels.push_back({drive_channel(drive_unit), to_string(drive_unit),
                             std::move(truth.drive),
                             test.level ? "constant, as set" : "as commanded"});
  record.notes.push_back("true force offset " + format_number(offset, 6) + " N");
  for (const std::string& description : {test.motion.description, test.drive.description})
    if (!description.empty()) record.notes.push_back(description);
  return record;
}

void require_usable(DriveUnit drive_unit, std::span<const BenchTest> tests,
                    const BenchOptions& options) {
  if (drive_unit == DriveUnit::None)
    throw Error("virtual bench", "the damper has no drive", "a damper driven in A or V");
  if (tests.empty())
    throw Error("virtual bench", "no motion or no drive level", "give at least one of each");
  if (!(options.sample_rate > 0)) throw Error("virtual bench", "the sample rate must be above 0");
  constexpr double kMostSamples = 1e8;
  double samples = 0;
  for (const BenchTest& test : tests) samples += test.motion.duration * options.sample_rate;
  if (samples > kMostSamples)
    throw Error(
        "virtual bench", "the campaign would have " + format_number(samples) + " samples",
        "at most " + format_number(kMostSamples) + ": shorter tests or a lower sample rate");
}

void require_usable(const SineMotion& motion, const BenchOptions& options) {
  if (!(options.sample_rate > 0 && options.cycles > 0))
    throw Error("virtual bench", "the sample rate and the cycles must be above 0");
  if (!(motion.amplitude > 0 && motion.frequency > 0 &&
        motion.frequency < options.sample_rate / 10))
    throw Error("virtual bench",
                "a motion of " + format_number(1000 * motion.amplitude) + " mm at " +
                    format_number(motion.frequency) + " Hz",
                "amplitude above 0, frequency above 0 and below a tenth of the sample rate");
}

}  // namespace

std::vector<BenchTest> bench_sines(const BenchOptions& options) {
  std::vector<BenchTest> tests;
  for (const SineMotion& motion : options.motions) {
    require_usable(motion, options);
    tests.push_back(sine_test(motion, std::max(options.cycles / motion.frequency, 1.0)));
  }
  return tests;
}

Dataset run_virtual_bench(const DamperModel& damper, DriveUnit drive_unit,
                          const BenchOptions& options) {
  std::vector<BenchTest> tests;
  for (const BenchTest& sine : bench_sines(options))
    for (const double level : options.drive_levels)
      tests.push_back(at_level(sine, level, drive_unit));
  return run_virtual_bench(damper, drive_unit, tests, options);
}

Dataset run_virtual_bench(const DamperModel& damper, DriveUnit drive_unit,
                          std::span<const BenchTest> tests, const BenchOptions& options) {
  require_usable(drive_unit, tests, options);
  Random random(options.seed);
  Dataset dataset;
  dataset.name = "virtual bench: " + damper.name();
  dataset.citation = "simulated by Dashpot, seed " + std::to_string(options.seed);
  dataset.drive_unit = drive_unit;
  for (const BenchTest& test : tests)
    dataset.records.push_back(run_test(damper, test, drive_unit, options, random));

  // Say what it is made of, so that nobody takes it for a measurement.
  dataset.notes.push_back("simulated, not measured; the true model is " +
                          format_json(damper.to_json(), false));
  dataset.notes.push_back(
      "force noise " + format_number(100 * options.force_noise) +
      " % of the span, displacement noise " + format_number(1e6 * options.displacement_noise) +
      " um" +
      (options.velocity_sensor
           ? ", velocity noise " + format_number(1e3 * options.velocity_noise) + " mm/s"
           : "") +
      ", resolution " + format_number(options.force_resolution) + " N and " +
      format_number(1e6 * options.displacement_resolution) + " um");
  return dataset;
}

}  // namespace dashpot
