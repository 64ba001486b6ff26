#pragma once
#include "dashpot/damper/inverse/observer.h"

namespace dashpot {

/// The inverse in closed form of every law whose force, at a given motion and state, is a
/// polynomial of the current, up to the third degree: Bingham, hyperbolic tangent,
/// semi-phenomenological, polynomial, LuGre, as far as their parameters' dependence allows it.
///
/// The polynomial is read off the law itself, at one current more than its degree, so that no
/// equation is written twice. Of several currents that give the force, the least; otherwise as
/// NumericInverse.
class PolynomialInverse final : public InverseModel {
 public:
  /// Throws Error when the force is no such polynomial.
  PolynomialInverse(const DamperModel& forward, const InverseLimits& limits);

  static constexpr int kMaxDegree = 3;

  std::string name() const override { return "polynomial"; }
  std::size_t state_size() const noexcept override { return observer_.state_size(); }
  void rest(const DamperInput& input, std::span<double> state) const noexcept override {
    observer_.rest(input, state);
  }
  int degree() const { return degree_; }
  const Observer& observer() const { return observer_; }
  /// Forces that differ by less, N, count as equal: no current changes anything.
  double negligible() const { return 1e-6 * observer_.current_effect(); }

 protected:
  double wanted_current(const InverseInput& input, std::span<double> state) const noexcept override;

 private:
  double misfit() const;

  Observer observer_;
  int degree_ = 0;
};

}  // namespace dashpot
