#pragma once
#include <optional>
#include <string>

#include "dashpot/drive.h"
#include "dashpot/record/excitation.h"

namespace dashpot {

/// One motion of the bench: a sine of this amplitude (m) and frequency (Hz).
struct SineMotion {
  double amplitude, frequency;
};

/// One run of the bench: a motion, and what drives the coil meanwhile.
struct BenchTest {
  std::string name;       ///< of the record
  std::string condition;  ///< of the motion
  PistonMotion motion;
  DriveSignal drive;
  std::optional<double> level;  ///< A or V where the drive is constant
};

/// Tests that lack their drive: a sine for this time, from rest at its lower end; a sequence (see
/// make_motion).
BenchTest sine_test(const SineMotion& sine, double duration);
BenchTest sequence_test(const std::string& motion, std::uint64_t seed,
                        const std::string& where = "motion");

/// The same motion under a constant drive, and under a sequence (see make_drive), which lasts as
/// long.
BenchTest at_level(BenchTest test, double level, DriveUnit drive_unit);
BenchTest under_sequence(BenchTest test, const std::string& drive, DriveFrame frame,
                         const std::string& where = "drive");

}  // namespace dashpot
