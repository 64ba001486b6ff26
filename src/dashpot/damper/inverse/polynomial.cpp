#include "dashpot/damper/inverse/polynomial.h"

#include <algorithm>
#include <cmath>
#include <math.h>  // the C texts say fabs, not std::fabs

#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr double kExact = 1e-8;  // of the current's effect: what rounding may do to a polynomial

struct PolynomialError {
  double c[PolynomialInverse::kMaxDegree + 1];
  double wanted;
};

// The functions that the C texts below call.

#include "dashpot/damper/c_text/polynomial_pieces.h"

using RootError = PolynomialError;
inline double root_error(const RootError* e, double s) {
  return polynomial_at(e->c, s) - e->wanted;
}
inline void observer_follow(const Observer* m, const InverseInput* input, double* state) {
  m->follow(*input, {state, m->state_size()});
}
inline double observer_force(const Observer* m, double current, const InverseInput* input,
                             double* state) {
  return m->force(current, *input, {state, m->state_size()});
}
constexpr double ROOT_NARROW = 1e-12, ROOT_TOLERANCE = 1e-15;

// clang-format off: the second builds on the first
#include "dashpot/damper/c_text/root_search.h"
#include "dashpot/damper/c_text/inverse_polynomial.h"
// clang-format on

PolynomialNumbers numbers_of(const PolynomialInverse& inverse) {
  return {inverse.degree(), inverse.limits().current_min, inverse.limits().current_max,
          inverse.negligible()};
}

}  // namespace

PolynomialInverse::PolynomialInverse(const DamperModel& forward, const InverseLimits& limits)
    : InverseModel(limits), observer_(forward, limits) {
  for (degree_ = 1; degree_ <= kMaxDegree; ++degree_)
    if (misfit() <= kExact * observer_.force_max()) return;
  throw Error(
      forward.name(),
      "its force is no polynomial of the current, so that no inverse in closed form is known",
      "take the numeric inverse");
}

/// Largest difference, N, between the force and its polynomial, between the currents that define
/// it.
double PolynomialInverse::misfit() const {
  constexpr int kPlaces = 13;

  double largest = 0;
  const PolynomialNumbers numbers = numbers_of(*this);
  observer_.probe([&](const InverseInput& input, std::span<double> state) {
    double c[kMaxDegree + 1];
    polynomial_force(&observer_, &numbers, &input, state.data(), c);

    // Compare at 13 currents, which are none of those that the polynomial goes through.
    for (int k = 0; k < kPlaces; ++k) {
      const double s = (k + 0.5) / kPlaces;
      const double current =
          limits().current_min + s * (limits().current_max - limits().current_min);
      largest =
          std::max(largest, std::abs(polynomial_at(c, s) - observer_.force(current, input, state)));
    }
  });
  return largest;
}

double PolynomialInverse::wanted_current(const InverseInput& input,
                                         std::span<double> state) const noexcept {
  const PolynomialNumbers numbers = numbers_of(*this);
  return polynomial_wanted(&observer_, &numbers, &input, state.data());
}

}  // namespace dashpot
