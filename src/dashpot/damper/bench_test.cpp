#include "dashpot/damper/bench_test.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/base/text.h"

namespace dashpot {
namespace {

/// "AM,carrier=3" as the name of a condition: without commas, which separate in lists.
std::string label_of(std::string sequence) {
  std::ranges::replace(sequence, ',', ' ');
  return sequence;
}

}  // namespace

BenchTest sine_test(const SineMotion& sine, double duration) {
  BenchTest test;
  test.condition =
      format_number(1000 * sine.amplitude) + " mm " + format_number(sine.frequency) + " Hz";
  test.motion.duration = duration;
  test.motion.at = [=, w = 2 * std::numbers::pi * sine.frequency](double t) -> MotionPoint {
    return {-sine.amplitude * std::cos(w * t), sine.amplitude * w * std::sin(w * t)};
  };
  return test;
}

BenchTest sequence_test(const std::string& motion, std::uint64_t seed, const std::string& where) {
  BenchTest test;
  test.condition = label_of(motion);
  test.motion = make_motion(motion, seed, where);
  return test;
}

BenchTest at_level(BenchTest test, double level, DriveUnit drive_unit) {
  test.name = test.condition + ", " + format_number(level) + " " + to_string(drive_unit);
  test.drive.at = [level](double) { return level; };
  test.level = level;
  return test;
}

BenchTest under_sequence(BenchTest test, const std::string& drive, DriveFrame frame,
                         const std::string& where) {
  frame.duration = test.motion.duration;
  test.name = test.condition + ", " + label_of(drive);
  test.drive = make_drive(drive, frame, where);
  return test;
}

}  // namespace dashpot
