#include "dashpot/damper/bench_experiments.h"

#include <algorithm>

#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

BenchOptions without_flaws() {
  BenchOptions options;
  options.force_noise = options.displacement_noise = options.force_offset = 0;
  options.force_resolution = options.displacement_resolution = 0;
  options.velocity_sensor = true;
  return options;
}

Record record_of(const DamperModel& damper, const BenchTest& test, const BenchOptions& options) {
  return run_virtual_bench(damper, DriveUnit::Ampere, std::vector{test}, options).records.at(0);
}

/// Force of a virtual damper over the last half of ten periods of a sine, seen in its F-v map.
struct Loop {
  double lowest = 1e9, highest = -1e9;
  double at_rest = 0;   ///< greatest |F| where the velocity is below 1 % of its largest
  double crossing = 0;  ///< greatest |v| at which F changes its sign
};

Loop loop_of(const std::string& damper, double amplitude, double frequency, double current) {
  const BenchTest test =
      at_level(sine_test({amplitude, frequency}, 10 / frequency), current, DriveUnit::Ampere);
  BenchOptions options = without_flaws();
  options.sample_rate = 1000 * frequency;
  const Record record = record_of(load_parameters(damper), test, options);
  const std::vector<double>& v = record.channel("velocity").samples;
  const std::vector<double>& force = record.channel("force").samples;
  Loop loop;
  for (std::size_t k = record.size() / 2; k < record.size(); ++k) {
    loop.lowest = std::min(loop.lowest, force[k]);
    loop.highest = std::max(loop.highest, force[k]);
    if (std::abs(v[k]) < 0.01 * 2 * M_PI * frequency * amplitude)
      loop.at_rest = std::max(loop.at_rest, std::abs(force[k]));
    if (force[k] * force[k - 1] < 0) loop.crossing = std::max(loop.crossing, std::abs(v[k]));
  }
  return loop;
}

constexpr double kFastest = 1.5 / (2 * M_PI * 15);  // m: at 15 Hz

}  // namespace

TEST_CASE(
    "a sequence through a viscous damper: force over the exact velocity, current as commanded") {
  const LawModel damper = LawModel::constant(find_law("bingham"), {5000, 0, 0, 0});
  const BenchTest test =
      under_sequence(sequence_test("FM,duration=5", 1), "APRBS", {.high = 2, .seed = 3});
  const Record record = record_of(damper, test, without_flaws());
  CHECK(record.name == "FM duration=5, APRBS");
  CHECK(record.condition == "FM duration=5");
  CHECK_FALSE(record.drive_level);
  CHECK(record.size() == 2501);
  const DriveSignal drive = make_drive("APRBS", {.high = 2, .duration = 5, .seed = 3});
  const PistonMotion motion = make_motion("FM,duration=5", 1);
  for (std::size_t k = 0; k < record.size(); k += 13) {
    CHECK_CLOSE(record.channel("force").samples[k], 5000 * motion.at(record.time[k]).velocity, 0,
                1e-6);
    CHECK_CLOSE(record.channel("velocity").samples[k], motion.at(record.time[k]).velocity, 0, 1e-9);
    CHECK(record.channel("current").samples[k] == drive.at(record.time[k]));
  }
}

TEST_CASE("the sensor of velocity has its noise, and changes no other channel") {
  const LawModel damper = LawModel::constant(find_law("bingham"), {5000, 0, 0, 0});
  const BenchTest test = at_level(sequence_test("AM,duration=20", 1), 1, DriveUnit::Ampere);
  BenchOptions noisy;
  noisy.velocity_sensor = true;
  noisy.velocity_noise = 0.01;
  const Record with = record_of(damper, test, noisy), without = record_of(damper, test, {});
  CHECK(with.channel("force").samples == without.channel("force").samples);
  double squares = 0;
  for (std::size_t k = 0; k < with.size(); ++k)
    squares +=
        std::pow(with.channel("velocity").samples[k] - test.motion.at(with.time[k]).velocity, 2);
  CHECK_CLOSE(std::sqrt(squares / static_cast<double>(with.size())), 0.01, 0.04, 0);
}

TEST_CASE("the one-sensor paper's table 2: sequences by experiment and damper") {
  const ParameterSet mr1 = load_parameter_set("mr1"), mr2 = load_parameter_set("mr2");
  const std::vector<BenchTest> first = experiment_tests("one-sensor", mr1, 1),
                               second = experiment_tests("one-sensor", mr2, 1);
  REQUIRE(first.size() == 5);
  REQUIRE(second.size() == 5);
  const char* motions[] = {"TPNVS", "SFS", "RP", "AM", "FM"};
  const char* continuous[] = {"SC: levels 10", "SC: levels 10", "ICPS", "ICPS", "ICPS"};
  const char* switched[] = {"SC: levels 2,", "SC: levels 2,", "PRBS", "PRBS", "PRBS"};
  for (std::size_t k = 0; k < 5; ++k) {
    CHECK(first[k].motion.description.starts_with(motions[k]));
    CHECK(second[k].motion.description.starts_with(motions[k]));
    CHECK(first[k].drive.description.starts_with(continuous[k]));
    CHECK(second[k].drive.description.starts_with(switched[k]));
    for (double t = 0; t < second[k].motion.duration; t += 0.037) {
      const double current = second[k].drive.at(t);
      CHECK((current == 0 || current == 2.5));
    }
  }
  // each constant sees the whole motion
  const double pass = first[1].motion.duration / 10;
  CHECK(first[1].drive.at(0.99 * pass) == 0);
  CHECK(first[1].drive.at(1.01 * pass) > 0);
  CHECK_CLOSE(first[1].motion.at(0.3 * pass).displacement,
              first[1].motion.at(1.3 * pass).displacement, 0, 1e-9);
  // the transient currents are not the same ones
  CHECK(first[2].drive.at(5) != first[3].drive.at(5));
  CHECK(message_of([&] {
          experiment_tests("one-sensor-6", mr1, 1);
        }).find("did you mean 'one-sensor-") != std::string::npos);
}

TEST_CASE("the paper's bench: 1650 Hz and a measured velocity") {
  const BenchOptions bench = one_sensor_bench({.force_noise = 0.03});
  CHECK(bench.sample_rate == 1650);
  CHECK(bench.velocity_sensor);
  CHECK(bench.force_noise == 0.03);
}

TEST_CASE(
    "mr1 is shaped like the paper's MR1: +-4000 N, hysteresis at high frequency within +-0.5 m/s") {
  const Loop fast = loop_of("mr1", kFastest, 15, 2.5), slow = loop_of("mr1", 0.025, 1, 2.5);
  CHECK_CLOSE(fast.highest, 4000, 0.05, 0);
  CHECK_CLOSE(fast.lowest, -4000, 0.05, 0);
  CHECK(fast.at_rest > 0.4 * 4000);
  CHECK(fast.crossing > 0.2);
  CHECK(fast.crossing < 0.5);
  CHECK(slow.at_rest < 0.05 * 4000);
  CHECK(slow.crossing < 0.01);
  // continuous: the force at every current lies between its neighbours'
  double before = 0;
  for (const double current : {0.0, 0.5, 1.0, 1.5, 2.0, 2.5}) {
    const double highest = loop_of("mr1", kFastest, 15, current).highest;
    CHECK(highest > before + 300);
    before = highest;
  }
}

TEST_CASE("mr2 is shaped like the paper's MR2: two levels, -6000 ... 11000 N, little hysteresis") {
  const ParameterSet mr2 = load_parameter_set("mr2");
  CHECK(mr2.drive_levels == std::vector<double>{0, 2.5});
  const Loop high = loop_of("mr2", kFastest, 15, 2.5), low = loop_of("mr2", kFastest, 15, 0);
  CHECK_CLOSE(high.highest, 11000, 0.03, 0);
  CHECK_CLOSE(high.lowest, -6000, 0.03, 0);
  CHECK(low.highest < 0.4 * high.highest);
  CHECK(low.lowest > 0.4 * high.lowest);
  CHECK(high.at_rest < 0.02 * 17000);
  // the force rises with the velocity at both levels
  std::vector<double> p(mr2.model.law().params.size());
  for (const double current : mr2.drive_levels) {
    mr2.model.parameters_at(current, p.data());
    double before = -1e9;
    for (double v = -1.5; v <= 1.5; v += 0.01) {
      const double force = mr2.model.law().force(p.data(), 0, v, &v);
      CHECK(force > before);
      before = force;
    }
  }
}

TEST_CASE("the second recording of an experiment: other sequences over the same ranges") {
  for (const char* name : {"mr1", "mr2"}) {
    const ParameterSet damper = load_parameter_set(name);
    const auto first = experiment_tests("one-sensor", damper, 1),
               second = experiment_tests("one-sensor", damper, 1, Recording::Second);
    REQUIRE(second.size() == 5);
    for (std::size_t k = 0; k < first.size(); ++k) {
      CAPTURE(first[k].name);
      double fastest = 0, again = 0, difference = 0;
      for (double t = 0; t < std::min(first[k].motion.duration, second[k].motion.duration);
           t += 0.037) {
        const double v = first[k].motion.at(t).velocity, w = second[k].motion.at(t).velocity;
        fastest = std::max(fastest, std::abs(v));
        again = std::max(again, std::abs(w));
        difference = std::max(difference, std::abs(v - w));
      }
      CHECK_CLOSE(again, fastest, 0.35, 0);
      CHECK(difference > 0.3 * fastest);
    }
    // Stepped currents fall where they rose.
    CHECK(first[0].drive.at(0) == damper.drive_min);
    CHECK(second[0].drive.at(0) == damper.drive_max);
    CHECK(second[0].drive.at(second[0].motion.duration) == damper.drive_min);
  }
}
