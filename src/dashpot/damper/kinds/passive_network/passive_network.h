#pragma once
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper/kinds/passive_network/passive_windows.h"
#include "dashpot/damper_input.h"
#include "dashpot/value.h"

namespace dashpot {

/// What a passive network drains at an instant, W, none of it ever below 0.
struct PassiveDrain {
  double creep = 0;     ///< resistances that drain springs by time
  double friction = 0;  ///< those that drain them by the way
  double viscous = 0;   ///< the viscous term
  double inertia = 0;   ///< the slip of the mass
};

/// A damper of springs, resistances and small networks that cannot generate energy, whatever its
/// numbers. c_text/passive_cell.h has the equations; docs/passive-network.md the proof. Plain data.
///
/// Its state: the lagged drive (with a lag), the memories, the forces of the springs, the follower
/// of the velocity (with inertia); all standardised.
struct PassiveNetwork {
  PassiveSizes sizes;
  bool lags = false, inert = false;

  double displacement_mean = 0;                        ///< m
  double displacement_scale = 0;                       ///< m; 0: displacement is not read
  double displacement_low = 0, displacement_high = 0;  ///< standardised, as all ranges
  double velocity_scale = 1;                           ///< m/s
  double velocity_low = -1, velocity_high = 1;         ///< the networks see v held within
  double drive_scale = 1;                              ///< A or V
  double drive_low = 0, drive_high = 2;
  double drive_fade = 0;     ///< so far beyond it networks read the drive no more; 0: they do
  double force_scale = 1;    ///< N
  double model_step = 1e-3;  ///< s; a longer step is divided, into 1000 at most

  /// By PassiveLayout: weights of networks, then numbers that are never negative. That no other
  /// condition has to hold is what passivity rests on.
  std::vector<double> numbers;

  static constexpr std::size_t kMaxSprings = 24, kMaxMemories = 12, kMaxNeurons = 48;
  static constexpr std::size_t kMaxInputs = 3 + kMaxMemories + kMaxSprings + 1;

  const PassiveNetwork& states() const noexcept { return *this; }
  std::size_t parameter_count() const noexcept { return numbers.size(); }
  std::size_t size() const noexcept {
    return (lags ? 1 : 0) + sizes.memories + sizes.springs + (inert ? 1 : 0);
  }
  bool reads_displacement() const noexcept { return displacement_scale > 0; }

  void rest(const DamperInput& input, std::span<double> state) const noexcept;
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept;
  void flow(const DamperInput& input, std::span<const double> state,
            std::span<double> rates) const noexcept;
  /// N.
  double force(const DamperInput& input, std::span<const double> state) const noexcept;

  /// What the springs, the potential and the inertia hold, J; less than a constant never. Between
  /// two instants it grows by no more than the work that the motion has done on the damper.
  double stored_energy(const DamperInput& input, std::span<const double> state) const noexcept;

  /// Where the rest of that work goes.
  PassiveDrain drain(const DamperInput& input, std::span<const double> state) const noexcept;

  Value to_json() const;
  /// Throws Error(where, ...) when the parts do not fit together, or a number that must not be
  /// negative is.
  void require_sound(const std::string& where) const;
};

}  // namespace dashpot
