#include "dashpot/damper/inverse/polynomial.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/error.h"
#include "dashpot/damper/inverse/first_root.h"

namespace dashpot {
namespace {

constexpr double kExact = 1e-8;       // of the current's effect: what rounding may do to a polynomial
constexpr double kNegligible = 1e-6;  // of the current's largest effect

/// Where the slope of c[0] + c[1] s + ... + c[3] s^3 vanishes within (0, 1), with 0 and 1: increasing.
int monotone_pieces(const std::array<double, 4>& c, double* places) {
  int count = 0;
  places[count++] = 0;
  const double a = 3 * c[3], b = 2 * c[2], root = b * b - 4 * a * c[1];
  if (root >= 0) {
    // The form that loses no digits when a is small or 0.
    const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
    const double first = c[1] / q, second = q / a;
    for (const double s : {std::min(first, second), std::max(first, second)})
      if (s > places[count - 1] && s < 1) places[count++] = s;
  }
  places[count++] = 1;
  return count;
}

}  // namespace

/// In s = 0 ... 1 over the current range.
struct PolynomialInverse::Polynomial {
  std::array<double, kMaxDegree + 1> c{};
  double at(double s) const noexcept { return c[0] + s * (c[1] + s * (c[2] + s * c[3])); }
};

PolynomialInverse::PolynomialInverse(const DamperModel& forward, const InverseLimits& limits)
    : InverseModel(limits), observer_(forward, limits) {
  for (degree_ = 1; degree_ <= kMaxDegree; ++degree_)
    if (misfit() <= kExact * observer_.force_max()) return;
  throw Error(forward.name(),
              "its force is no polynomial of the current, so that no inverse in closed form is known",
              "take the numeric inverse");
}

PolynomialInverse::Polynomial PolynomialInverse::force_over_range(const InverseInput& input,
                                                                  std::span<double> state) const noexcept {
  const double low = limits().current_min, range = limits().current_max - low;
  std::array<double, kMaxDegree + 1> f{};
  for (int k = 0; k <= degree_; ++k) f[k] = observer_.force(low + range * k / degree_, input, state);
  // Newton's form on equal steps, multiplied out.
  const double n = degree_, d1 = f[1] - f[0], d2 = f[2] - 2 * f[1] + f[0];
  const double d3 = f[3] - 3 * f[2] + 3 * f[1] - f[0];
  if (degree_ == 1) return {{f[0], d1}};
  if (degree_ == 2) return {{f[0], n * (d1 - d2 / 2), n * n * d2 / 2}};
  return {{f[0], n * (d1 - d2 / 2 + d3 / 3), n * n * (d2 - d3) / 2, n * n * n * d3 / 6}};
}

/// Largest difference, N, between the force and its polynomial, between the currents that define it.
double PolynomialInverse::misfit() const {
  constexpr int kPlaces = 13;
  double largest = 0;
  observer_.probe([&](const InverseInput& input, std::span<double> state) {
    const Polynomial force = force_over_range(input, state);
    for (int k = 0; k < kPlaces; ++k) {
      const double s = (k + 0.5) / kPlaces;
      const double current = limits().current_min + s * (limits().current_max - limits().current_min);
      largest = std::max(largest, std::abs(force.at(s) - observer_.force(current, input, state)));
    }
  });
  return largest;
}

double PolynomialInverse::wanted_current(const InverseInput& input, std::span<double> state) const noexcept {
  observer_.follow(input, state);
  const Polynomial force = force_over_range(input, state);
  std::array<double, kMaxDegree + 1> places;
  const int count = monotone_pieces(force.c, places.data());
  const auto error = [&](double s) { return force.at(s) - input.wanted; };
  const FirstRoot found = first_root(error, std::span(places).first(static_cast<std::size_t>(count)), 1e-15);
  if (!found.crosses && found.variation <= kNegligible * observer_.current_effect()) return input.current;
  return limits().current_min + found.place * (limits().current_max - limits().current_min);
}

}  // namespace dashpot
