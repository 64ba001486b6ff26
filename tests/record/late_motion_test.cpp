#include "dashpot/record/late_motion.h"

#include <cmath>
#include <numbers>

#include "support.h"

using namespace dashpot;

namespace {

/// What a record has beside the damper: when its motion is recorded, and what moves with it.
struct Bench {
  double late = 0;  ///< s, of the motion behind the force
  double mass = 0;  ///< kg
};

/// A sine at 1 kHz for 3 s against friction of Dahl's that is unlike in both directions, a damping
/// that gives way at speed, a gas spring and noise: nothing that the doubt could describe exactly.
Record sine(double stroke, double hertz, double friction, const Bench& bench) {
  constexpr double kInterval = 1e-3, kGives = 3e-4;  // s, m
  constexpr int kFine = 10;
  const double w = 2 * std::numbers::pi * hertz;
  const auto place = [&](double t) { return stroke * std::sin(w * t); };
  const auto speed = [&](double t) { return stroke * w * std::cos(w * t); };

  Record record;
  record.name = "sine";
  record.sample_time = kInterval;
  record.drive_level = friction;
  Channel x{"displacement", "m"}, v{"velocity", "m/s"}, f{"force", "N"};
  double held = 0;
  unsigned noise = 1;
  for (int k = 0; k < 3000; ++k) {
    const double t = kInterval * k;
    for (int fine = 0; fine < kFine; ++fine) {
      const double now = speed(t + fine * kInterval / kFine), most = now > 0 ? 1 : 0.7;
      held += kInterval / kFine * (now - std::abs(now) * held / most) / kGives;
    }
    noise = noise * 1664525u + 1013904223u;
    const double there = speed(t + kInterval);
    record.time.push_back(t);
    x.samples.push_back(place(t + kInterval - bench.late));
    v.samples.push_back(speed(t + kInterval - bench.late));
    f.samples.push_back(friction * held + 900 * there / (1 + std::abs(there)) -
                        180 / (1 + place(t + kInterval) / 0.12) -
                        bench.mass * w * w * place(t + kInterval) +
                        2e-9 * static_cast<double>(noise));
  }
  record.channels = {x, v, f};
  return record;
}

/// Two motions at two drives.
std::vector<Record> campaign(const Bench& bench) {
  std::vector<Record> records;
  for (const double friction : {150.0, 600.0}) {
    records.push_back(sine(0.005, 1, friction, bench));
    records.push_back(sine(0.005, 5, friction, bench));
  }
  return records;
}

}  // namespace

TEST_CASE("a motion that is recorded late is told, with its delay") {
  const auto doubt = doubt_about_timing(campaign({.late = 0.004}));
  REQUIRE(doubt);
  CHECK(doubt->record == "sine");
  CHECK_MESSAGE(doubt->why.find("some 4 ms later than the force") != std::string::npos, doubt->why);
}

TEST_CASE("no delay is told of a sound record, of a moving mass, nor of a force that comes late") {
  CHECK(!doubt_about_timing(campaign({})));
  for (const double mass : {3.0, 10.0, 30.0}) {
    const std::vector<Record> moving = campaign({.mass = mass});
    CHECK(!doubt_about_timing(std::span(moving).first(2)));
    CHECK(!doubt_about_timing(std::span(moving).last(2)));
  }
  CHECK(!doubt_about_timing(campaign({.late = -0.004})));
}

TEST_CASE(
    "a delay is not asked of one motion, of a drive that varies, nor of stamps uneven or few") {
  const std::vector<Record> all = campaign({.late = 0.004}), one{all[0], all[2]};
  CHECK(!doubt_about_timing(one));

  std::vector<Record> varies = all, uneven = all, brief = all;
  for (Record& record : varies) record.drive_level.reset();
  for (Record& record : uneven) record.sample_time = 0;
  for (Record& record : brief) record.sample_time = 1e-6;
  CHECK(!doubt_about_timing(varies));
  CHECK(!doubt_about_timing(uneven));
  CHECK(!doubt_about_timing(brief));
}
