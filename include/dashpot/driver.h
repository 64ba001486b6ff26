// Layer: damper
#pragma once

// The electronics between a controller's command and the current in the coil. A Driver is
// immutable; its state, kStates numbers, is the caller's.

#include <limits>
#include <span>

namespace dashpot {

/// The way of a commanded current to the coil: sampling, limits, a limited rate and a first-order
/// lag, in this order.
struct DriverOptions {
  double current_min = 0, current_max = 1;                    ///< A (or V)
  double rate_max = std::numeric_limits<double>::infinity();  ///< A/s
  double lag_rate = 0;                                        ///< 1/s; 0: no lag
  /// s between the instants at which it looks at its command; 0: at every command.
  double period = 0;
};

/// The coil's driver. The state is the caller's; exact for a command that is constant between
/// calls.
class Driver {
 public:
  /// Throws Error on limits, rates or a period that make no sense.
  explicit Driver(const DriverOptions& options);

  static constexpr std::size_t kStates = 5;
  static constexpr double kInstant = 1e-10;  ///< s: a corner that is nearer than this is met
  /// The state after a long rest at this current; the next command is a sampling instant.
  void rest(double current, std::span<double> state) const noexcept;
  /// Takes a new command. A coil without lag and rate limit answers at once. NaN keeps the last
  /// command.
  void command(double current, std::span<double> state) const noexcept;
  /// Brings the coil's current dt seconds further.
  void advance(double dt, std::span<double> state) const noexcept;
  /// s until the current's course has a corner by itself, at an instant of its own sampling or
  /// where a limited rate ends; infinite where none comes.
  double next_corner(std::span<const double> state) const noexcept;
  /// Call it at a corner: takes a command that waited for a sampling instant, and ends a rate's
  /// ramp.
  void meet_corner(std::span<double> state) const noexcept;
  /// Whether the current stays as it is without another command.
  bool is_steady(std::span<const double> state) const noexcept;
  /// The current in the coil, A.
  double current(std::span<const double> state) const noexcept { return state[kCoil]; }

  const DriverOptions& options() const { return options_; }

 private:
  // kRamp: the rate-limited current before the lag; kWait: s until the next sampling instant
  enum State { kCoil, kAsked, kHeld, kRamp, kWait };
  void follow(double dt, std::span<double> state) const noexcept;

  DriverOptions options_;
};

}  // namespace dashpot
