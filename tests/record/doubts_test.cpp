#include "dashpot/record/doubts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/dataset.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A sine of 20 mm and 1 Hz against friction, a spring and a little noise, at the resolution of a
/// sensor of 14 bits: nothing speaks against it.
Record sound_record() {
  Record record;
  record.name = "sine";
  record.sample_time = 0.002;
  Channel x{"displacement", "m"}, f{"force", "N"};
  unsigned noise = 1;
  for (int k = 0; k < 2000; ++k) {
    noise = noise * 1664525u + 1013904223u;
    const double t = 0.002 * k, angle = 2 * std::numbers::pi * t;
    const double v = std::cos(angle);
    record.time.push_back(t);
    x.samples.push_back(std::round(0.02 * std::sin(angle) / 5e-6) * 5e-6);
    const double force = 400 * std::tanh(8 * v) + 300 * v + 5e3 * 0.02 * std::sin(angle) +
                         2e-9 * static_cast<double>(noise);
    f.samples.push_back(std::round(force / 0.25) * 0.25);
  }
  record.channels = {x, f};
  return record;
}

std::vector<double>& samples(Record& record, std::string_view name) {
  return record.find(name)->samples;
}

std::string only_doubt(const Record& record) {
  const std::vector<std::string> doubts = doubts_about(record);
  REQUIRE(doubts.size() == 1);
  return doubts.front();
}

}  // namespace

TEST_CASE("nothing speaks against a sound record, nor against one that rests") {
  CHECK(doubts_about(sound_record()).empty());
  Record at_rest = sound_record();
  for (const char* name : {"displacement", "force"})
    std::ranges::fill(samples(at_rest, name), 1.25);
  CHECK(doubts_about(at_rest).empty());
}

TEST_CASE("a force that has lost its sign is told; one that gas keeps at one sign is not") {
  Record record = sound_record();
  for (double& force : samples(record, "force")) force = std::abs(force - 60);
  CHECK(contains(only_doubt(record), "one sign whichever way the damper goes"));

  // Nor one that a sensor of one direction cuts off at 0.
  record = sound_record();
  for (double& force : samples(record, "force")) force = std::max(force, 0.0);
  for (const std::string& doubt : doubts_about(record)) CHECK_FALSE(contains(doubt, "one sign"));
  for (const double gas : {-800.0, -900.0, 900.0}) {
    record = sound_record();
    for (double& force : samples(record, "force")) force += gas;
    CHECK(doubts_about(record).empty());
  }
}

TEST_CASE("a yield force that leaps over zero has lost its sign all the same") {
  const auto force_of = [](double yield, double viscous, double gas, double spring) {
    Record record = sound_record();
    for (std::size_t k = 0; k < record.size(); ++k) {
      const double angle = 2 * std::numbers::pi * record.time[k], v = std::cos(angle);
      samples(record, "force")[k] =
          gas + spring * std::sin(angle) + std::copysign(yield, v) + viscous * v;
    }
    return record;
  };
  Record record = force_of(500, 250, 0, 0);
  for (double& force : samples(record, "force")) force = std::abs(force);
  CHECK(contains(only_doubt(record), "one sign whichever way the damper goes"));

  // Weak dampers beside much gas, and beside a spring.
  CHECK(doubts_about(force_of(500, 250, 1000, 0)).empty());
  CHECK(doubts_about(force_of(20, 10, -2000, 30)).empty());
  CHECK(doubts_about(force_of(5, 1, 2000, 800)).empty());
}

TEST_CASE("a force that sticks while the damper moves is told with its time") {
  Record record = sound_record();
  std::fill_n(samples(record, "force").begin() + 600, 200, 123.5);
  CHECK(contains(only_doubt(record), "the force stands at 123.5 N from 1.2 s to 1.598 s"));
}

TEST_CASE(
    "friction that stands on one step of a coarse sensor is no stuck one, through a turn it is") {
  Record friction = sound_record();
  std::vector<double>& force = samples(friction, "force");
  for (std::size_t k = 0; k < force.size(); ++k) {
    const double v = std::cos(2 * std::numbers::pi * friction.time[k]);
    force[k] = std::round(15 * std::tanh(20 * v) + (k % 200 == 150 ? 0.6 : 0));
  }
  CHECK(doubts_about(friction).empty());

  std::fill_n(force.begin() + 600, 200, force[600]);
  CHECK(contains(only_doubt(friction), "to 1.598 s while the damper moves: the sensor stuck"));
}

TEST_CASE("a displacement that sticks and leaps is told; one that dwells is not") {
  Record record = sound_record();
  std::vector<double>& x = samples(record, "displacement");
  std::fill_n(x.begin() + 480, 40, x[480]);
  CHECK(contains(only_doubt(record), "the displacement stands still from 0.96 s to 1.038 s"));

  Record dwelling = sound_record();
  for (double& value : samples(dwelling, "displacement")) value = std::clamp(value, -0.012, 0.012);
  CHECK(doubts_about(dwelling).empty());
}

TEST_CASE("a displacement that dies before the end is told; a motion that ends at rest is not") {
  Record dead = sound_record();
  std::vector<double>& x = samples(dead, "displacement");
  std::fill(x.begin() + 1130, x.end(), x[1130]);
  CHECK(contains(only_doubt(dead),
                 "the displacement stands still from 2.26 s to 3.998 s, the end of the record, "
                 "while the force goes on: the sensor died"));

  Record ends = sound_record();
  for (const char* name : {"displacement", "force"})
    std::fill(samples(ends, name).begin() + 1130, samples(ends, name).end(),
              samples(ends, name)[1130]);
  CHECK(doubts_about(ends).empty());
}

TEST_CASE("a displacement that stands still anywhere while the force goes on is told") {
  Record late = sound_record();
  std::vector<double>& x = samples(late, "displacement");
  std::fill_n(x.begin(), 1000, x[1000]);
  CHECK(contains(only_doubt(late),
                 "the displacement stands still from 0 s to 2 s, the start of the record, while "
                 "the force goes on: the sensor stuck; 'cut' in a dataset file"));

  // Whole cycles, so that nothing leaps behind them.
  Record between = sound_record();
  std::fill_n(samples(between, "displacement").begin() + 500, 1001,
              samples(between, "displacement")[500]);
  CHECK(contains(only_doubt(between),
                 "the displacement stands still from 1 s to 3 s while the "
                 "force goes on: the sensor stuck"));

  Record dead = sound_record();
  std::ranges::fill(samples(dead, "displacement"), 0.003);
  CHECK(contains(only_doubt(dead),
                 "the displacement stands still throughout while the force goes "
                 "on: the sensor is dead, or the column another one"));

  // The noise of a force at rest is no motion.
  Record at_rest = dead;
  unsigned noise = 1;
  for (double& value : samples(at_rest, "force")) {
    noise = noise * 1664525u + 1013904223u;
    value = 4e-9 * static_cast<double>(noise);
  }
  CHECK(doubts_about(at_rest).empty());
}

TEST_CASE("a velocity that sticks while the displacement goes on is told; a steady one is not") {
  Record record = sound_record();
  Channel velocity{"velocity", "m/s"};
  for (const double t : record.time)
    velocity.samples.push_back(0.04 * std::numbers::pi * std::cos(2 * std::numbers::pi * t));
  record.channels.push_back(velocity);
  std::fill_n(samples(record, "velocity").begin() + 625, 200, 0);
  CHECK(contains(only_doubt(record),
                 "the velocity stands at 0 m/s from 1.25 s to 1.648 s while "
                 "the displacement goes"));

  // One that is dead for whole cycles, after which the displacement is back.
  Record dead = record;
  std::ranges::fill(samples(dead, "velocity"), 0);
  CHECK(contains(only_doubt(dead), "the velocity stands at 0 m/s from 0 s to "));

  // A ramp to and fro, and the friction of it.
  Record ramp = record;
  for (std::size_t k = 0; k < ramp.size(); ++k) {
    const double phase = static_cast<double>(k % 500), up = phase < 250 ? 1 : -1;
    samples(ramp, "displacement")[k] = 1e-4 * (phase < 250 ? phase : 500 - phase);
    samples(ramp, "velocity")[k] = 0.05 * up;
    samples(ramp, "force")[k] = 300 * up + 0.1 * static_cast<double>(k * 7 % 5);
  }
  CHECK(doubts_about(ramp).empty());
}

TEST_CASE("a value that stands for a missing one is told; a peak that is held is none") {
  Record record = sound_record();
  std::fill_n(samples(record, "force").begin() + 600, 15, -9999.0);
  CHECK(contains(only_doubt(record),
                 "the force is -9999 N in 15 samples, the first at 1.2 s, far from all others, as "
                 "loggers write where they have no value"));

  Record peak = sound_record();
  std::fill_n(samples(peak, "force").begin() + 600, 15, 2500.0);
  CHECK(doubts_about(peak).empty());
}

TEST_CASE("samples that a logger lost are told with their number") {
  Record record = sound_record();
  record.sample_time = 0;
  for (const std::size_t first : {1500u, 400u}) {
    const auto drop = [&](std::vector<double>& values) {
      values.erase(values.begin() + static_cast<std::ptrdiff_t>(first),
                   values.begin() + static_cast<std::ptrdiff_t>(first + 2));
    };
    drop(record.time);
    for (Channel& channel : record.channels) drop(channel.samples);
  }
  CHECK(contains(only_doubt(record),
                 "4 samples are missing in 2 places by the time stamps, the "
                 "first behind 0.798 s: the logger lost them"));

  // Stamps that jitter are another matter.
  Record jitter = sound_record();
  jitter.sample_time = 0;
  for (std::size_t k = 0; k < jitter.size(); k += 3) jitter.time[k] += 5e-4;
  CHECK(doubts_about(jitter).empty());
}

TEST_CASE("a clipped force is told with its limit") {
  Record record = sound_record();
  for (double& value : samples(record, "force")) value = std::min(value, 600.0);
  CHECK(contains(only_doubt(record), "the force is clipped at 600 N"));
}

TEST_CASE("spikes of one sample are told with their number; a step is none") {
  Record record = sound_record();
  for (const std::size_t k : {300u, 900u, 1700u}) samples(record, "force")[k] += 2000;
  CHECK(contains(only_doubt(record), "the force has 3 spikes of one sample, the first at 0.6 s"));

  Record step = sound_record();
  for (std::size_t k = 1000; k < step.size(); ++k) samples(step, "force")[k] += 2000;
  CHECK(doubts_about(step).empty());
}

TEST_CASE("a last number that was cut and values of no damper are told") {
  Record cut = sound_record();
  samples(cut, "force").back() *= 100;
  CHECK(contains(only_doubt(cut), "the force leaps at the last sample"));
  Record ranges = sound_record();
  samples(ranges, "force").front() = 10000;
  CHECK(contains(only_doubt(ranges), "the force leaps behind the first sample, which may be none"));

  Record unit = sound_record();
  for (double& value : samples(unit, "displacement")) value *= 1000;
  CHECK(contains(only_doubt(unit), "the displacement spans 40 m: is its unit m right?"));
}

TEST_CASE("a velocity of another size, sign or time than the displacement's is told") {
  const auto with_velocity = [](double size, double late) {
    Record record = sound_record();
    Channel velocity{"velocity", "m/s"};
    for (const double t : record.time)
      velocity.samples.push_back(size * 0.04 * std::numbers::pi *
                                 std::cos(2 * std::numbers::pi * (t - late)));
    record.channels.push_back(velocity);
    return record;
  };
  CHECK(doubts_about(with_velocity(1, 0)).empty());
  CHECK(contains(only_doubt(with_velocity(25.4, 0)), "the velocity is 25."));
  CHECK(contains(only_doubt(with_velocity(-1, 0)), "one of the two has the other sign"));

  // By a filter behind one of the two, to within half a millisecond or a sample.
  CHECK(contains(only_doubt(with_velocity(1, 0.012)), "the velocity comes 12 ms later than"));
  CHECK(contains(only_doubt(with_velocity(0.9, -0.006)), "the velocity comes 6 ms earlier than"));
  CHECK(doubts_about(with_velocity(1, 0.001)).empty());
}

TEST_CASE("a displacement that is another column is told by the velocity beside it") {
  Record record = sound_record();
  Channel velocity{"velocity", "m/s"};
  for (const double t : record.time)
    velocity.samples.push_back(0.04 * std::numbers::pi * std::cos(2 * std::numbers::pi * t));
  record.channels.push_back(velocity);

  // The force stands in its place: it goes with the velocity, as if in mm.
  for (std::size_t k = 0; k < record.size(); ++k)
    samples(record, "displacement")[k] = 0.3 * std::tanh(50 * velocity.samples[k]);
  CHECK(contains(only_doubt(record), " times as far as the velocity would take it"));
}

TEST_CASE("a channel that was sampled more slowly and held is told with its rate") {
  Record record = sound_record();
  std::vector<double>& x = samples(record, "displacement");
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = x[k - k % 10];
  CHECK(contains(only_doubt(record),
                 "the displacement stands for 10 samples at a time: it was sampled at 50 Hz"));

  Record other = sound_record();
  std::vector<double>& force = samples(other, "force");
  for (std::size_t k = 0; k < force.size(); ++k) force[k] = force[k - k % 5 % 3];
  CHECK(contains(only_doubt(other), "the force stands for"));

  // A coarse sensor stands as well, and goes on by one step of its resolution.
  Record coarse = sound_record();
  for (double& value : samples(coarse, "displacement")) value = std::round(value / 5e-4) * 5e-4;
  CHECK(doubts_about(coarse).empty());
}

TEST_CASE("a suspect record of a folder is used, and told first") {
  const TemporaryFolder folder;
  std::string rows = "t [s],x [mm],F [N]\n";
  const Record record = sound_record();
  for (std::size_t k = 0; k < record.size(); ++k)
    rows += std::to_string(record.time[k]) + "," +
            std::to_string(1e3 * record.channel("displacement").samples[k]) + "," +
            std::to_string(std::min(record.channel("force").samples[k], 600.0)) + "\n";
  const Dataset dataset = load_dataset({folder.write("run_0.5A.csv", rows)});
  REQUIRE(dataset.suspects.size() == 1);
  CHECK(contains(dataset.suspects[0].why, "clipped"));
  CHECK(dataset.notes.front().starts_with("suspect: "));
  CHECK(contains(describe(dataset), "suspect: the force is clipped at 600 N"));
}
