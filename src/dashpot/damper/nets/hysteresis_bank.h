#pragma once
#include <span>
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

/// States that motion and command drive and that nothing feeds back to, so that they are bounded
/// for any rates:
///
///   Dahl states     w' = rho (v - |v| w), rho in 1/m: -1 ... 1, where the damper stands since it
///                   last turned
///   velocity lags   y' = lambda (v - y), lambda in 1/s: v - y stands for acceleration, or, where
///   the
///                   lag is slow, for the displacement
///   current lags    u' = mu (i - u), mu in 1/s: coil, supply and fluid behind their command
///
/// After P. R. Dahl, AIAA J. 14 (1976) 1675, with a bank of rates in place of one. A description
/// only: the state is the caller's, size() numbers.
struct HysteresisBank {
  std::vector<double> path_rates;      ///< rho
  std::vector<double> velocity_rates;  ///< lambda
  std::vector<double> current_rates;   ///< mu

  /// Dahl states, velocity lags, current lags, in this order; so are rates() and every array below.
  std::size_t size() const noexcept {
    return path_rates.size() + velocity_rates.size() + current_rates.size();
  }
  /// Throws Error, beginning with `where`, when a rate is not a positive number.
  void require_sound(const std::string& where) const;
  std::vector<double> rates() const;
  void set_rates(std::span<const double> rates);

  /// State after a long rest at the input's current.
  void rest(const DamperInput& input, std::span<double> state) const noexcept;
  /// Exact for inputs that are linear over the step. `slopes`, when not empty: the states'
  /// derivatives by the logarithms of their own rates, brought along.
  void advance(const DamperInput& from, const DamperInput& to, double dt, std::span<double> state,
               std::span<double> slopes = {}) const noexcept;

  /// The states' derivatives by time.
  void flow(const DamperInput& input, std::span<const double> state,
            std::span<double> rates) const noexcept;

  /// Signals that a network reads, signal_count() numbers: v, w of each Dahl state, v - y of each
  /// velocity lag, u of each current lag.
  std::size_t signal_count() const noexcept { return 1 + size(); }
  void read(const DamperInput& input, std::span<const double> state,
            double* signals) const noexcept;
};

}  // namespace dashpot
