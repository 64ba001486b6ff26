#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/parameter_table.h"

namespace dashpot {

/// Position and speed of the piston at an instant.
struct MotionPoint {
  double displacement, velocity;  ///< m, m/s
};

/// A motion for a test bench: displacement and its exact derivative at any time t in 0 ...
/// duration, s.
struct PistonMotion {
  std::string description;  ///< "AM: amplitude 0.025 m, ..."
  double duration = 0;      ///< s
  std::function<MotionPoint(double t)> at;
};

/// The drive of the coil, A or V, at any time t >= 0, s.
struct DriveSignal {
  std::string description;
  std::function<double(double t)> at;
};

/// The texts that lists and documentation show of a sequence, in UTF-8. `params` is the table from
/// which values are parsed, checked and described.
struct SequenceInfo {
  std::string_view name, title, equation, source, remarks;
  std::vector<ParameterRow> params;
};

/// A motion known by name: within its amplitude, its band of frequencies and its limit of speed,
/// and from rest. The same seed gives the same motion.
struct MotionSequence {
  SequenceInfo info;
  PistonMotion (*make)(std::span<const double> values, std::uint64_t seed);
};

/// The range and duration that a drive sequence fills. The range is that of the one-sensor paper
/// unless stated.
struct DriveFrame {
  double low = 0, high = 2.5;  ///< A or V
  double duration = 60;        ///< s
  std::uint64_t seed = 1;
};

struct DriveSequence {
  SequenceInfo info;
  DriveSignal (*make)(std::span<const double> values, const DriveFrame& frame);
};

/// Both in alphabetical order.
std::span<const MotionSequence> motion_sequences();
std::span<const DriveSequence> drive_sequences();

/// Makes one from a text like "AM" or "AM,carrier=10,amplitude=4mm": a name in any case, and values
/// for some of its parameters, in the unit of the table unless one is stated. The results own what
/// they need and may be copied and called from several threads. Throws Error(where, ...) on an
/// unknown name or parameter and on a value that is out of bounds.
PistonMotion make_motion(const std::string& text, std::uint64_t seed,
                         const std::string& where = "motion");
DriveSignal make_drive(const std::string& text, const DriveFrame& frame,
                       const std::string& where = "drive");

/// The first `count` bits of the maximum-length sequence of a shift register of `order` bits (3 ...
/// 16) that starts with `start` in it, whose lowest `order` bits must not all be 0. Its period is
/// 2^order - 1. Throws Error otherwise.
std::vector<bool> maximum_length_bits(int order, std::uint32_t start, std::size_t count);

}  // namespace dashpot
