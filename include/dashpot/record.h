// Layer: record
#pragma once

// One recording of a test run: channels on a common time base, in SI. Records are values: copies
// and slices own their samples.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dashpot {

/// The names that Dashpot gives meaning to, with their SI units. Other channels are carried along.
///   displacement m, velocity m/s, acceleration m/s^2 (extension positive); force N (positive when
///   it resists extension); current A or voltage V: what drives the coil; temperature K.
struct StandardChannel {
  std::string_view name, unit;
};
std::span<const StandardChannel> standard_channels();

/// Samples of one quantity, in SI.
struct Channel {
  std::string name;
  std::string unit;  ///< SI unit text
  std::vector<double> samples;
  std::string origin;  ///< "column x_mm, mm -> m" or "derived from displacement, 30 Hz zero-phase"
};

/// The part of a record in a division that its dataset file states.
enum class Role { Unassigned, Training, LeftOut };

/// One test run: channels on one time base, with its conditions and its source. Invariant: `time`
/// and all `samples` are equally long. A record owns its samples; slices copy them.
struct Record {
  std::string name;       ///< unique in its dataset
  std::string source;     ///< file, and the part of it: "ME5mm3Hz.txt.gz, rows 9308-17607"
  std::string condition;  ///< the motion: records at several currents under one motion share it
  std::optional<double> drive_level;  ///< A or V when it is constant over the record
  /// The other constant quantities, in SI: gap m, yield_stress Pa, viscosity Pa*s, temperature K
  /// ...
  std::vector<std::pair<std::string, double>> conditions;
  double moving_mass = 0;    ///< kg, between load cell and damper: its inertia is not in the force
  std::vector<double> time;  ///< s, increasing, one per sample
  double sample_time = 0;    ///< s when uniformly sampled, else 0
  std::vector<Channel> channels;
  std::size_t warm_up = 0;  ///< first samples that are simulated but not scored
  Role role = Role::Unassigned;
  std::vector<std::string> notes;  ///< what was done to it: cuts, signs, filters

  std::size_t size() const { return time.size(); }
  /// nullptr where the record has no such channel.
  const Channel* find(std::string_view name) const;
  Channel* find(std::string_view name);
  /// Throws Error naming the record and the channels that it has.
  const Channel& channel(std::string_view name) const;
  /// Samples first ... last-1 of every channel, as a record of its own. Both are cut off at size().
  /// The warm-up is what is left of it behind `first`.
  Record slice(std::size_t first, std::size_t last) const;
  /// Becomes that slice, without new memory.
  void keep(std::size_t first, std::size_t last);
};

}  // namespace dashpot
