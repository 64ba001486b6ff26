#pragma once
#include "dashpot/damper/inverse/observer.h"

namespace dashpot {

/// The inverse of any model: the least current at which the forward model gives the wanted force,
/// found by a bracketed search. A free run of the model, driven by the coil's current, supplies its
/// states.
///
/// Where no current gives the force, the one that comes nearest; where current has no effect, the
/// present one. Finds the first crossing among eight equal parts of the current range, so a force
/// that rises and falls within one of them may hide its crossing.
class NumericInverse final : public InverseModel {
 public:
  NumericInverse(const DamperModel& forward, const InverseLimits& limits);

  std::string name() const override { return "numeric"; }
  std::size_t state_size() const noexcept override { return observer_.state_size() + kOwn; }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override;
  const Observer& observer() const { return observer_; }
  /// Forces that differ by less, N, count as equal: no current changes anything.
  double negligible() const { return 1e-6 * observer_.current_effect(); }

 protected:
  double wanted_current(const InverseInput& input, std::span<double> state) const noexcept override;

 private:
  // The last solution; +1 or -1: its error rose or fell with current.
  static constexpr std::size_t kOwn = 2;

  Observer observer_;
};

}  // namespace dashpot
