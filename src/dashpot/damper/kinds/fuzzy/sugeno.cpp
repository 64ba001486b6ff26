#include "dashpot/damper/kinds/fuzzy/sugeno.h"

#include <algorithm>
#include <cmath>

namespace dashpot {
namespace {

/// Memberships end at e^-80: the product of Sugeno::kMaxTerms of them is still a normal number.
constexpr double kMaxExponent = 80;

/// The bell and the sigmoid are 1 / (1 + e^E), the Gaussian is e^-E.
double exponent(const Membership& m, double x) noexcept {
  const double u = (x - m.centre) / m.width;
  if (m.shape == Membership::Shape::Bell) return m.slope * std::log(u * u);
  return m.shape == Membership::Shape::Gaussian ? 0.5 * u * u : -m.slope * (x - m.centre);
}

}  // namespace

double Membership::at(double x) const noexcept {
  const double e = std::min(exponent(*this, x), kMaxExponent);
  return shape == Shape::Gaussian ? std::exp(-e) : 1 / (1 + std::exp(e));
}

std::array<double, 3> Membership::log_gradient(double x, double value) const noexcept {
  const double away = x - centre;
  if (away == 0 && shape != Shape::Sigmoid) return {0, 0, 0};
  const double e = exponent(*this, x);
  if (shape == Shape::Gaussian) return {away / (width * width), 2 * e, 0};
  const double rest = 1 - value;
  if (shape == Shape::Sigmoid) return {-rest * slope, 0, -rest * e};
  return {rest * 2 * slope / away, rest * 2 * slope, -rest * e};
}

std::size_t Sugeno::parameter_count() const noexcept {
  std::size_t count = consequent_count();
  for (const Membership& membership : memberships) count += membership.parameter_count();
  return count;
}

void Sugeno::standardise(const double* raw, double* linear, double* held) const noexcept {
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    linear[k] = (raw[k] - inputs[k].mean) / inputs[k].scale;
    held[k] = std::clamp(linear[k], inputs[k].low, inputs[k].high);
  }
}

void Sugeno::share(const double* held, double* values, double* shares) const noexcept {
  for (std::size_t m = 0; m < memberships.size(); ++m)
    values[m] = memberships[m].at(held[memberships[m].input]);
  double sum = 0;
  for (std::size_t r = 0; r < rules.size(); ++r) {
    shares[r] = 1;
    for (const std::size_t m : rules[r]) shares[r] *= values[m];
    sum += shares[r];
  }
  for (std::size_t r = 0; r < rules.size(); ++r) shares[r] /= sum;
}

double Sugeno::evaluate(const double* raw) const noexcept {
  std::array<double, kMaxInputs> linear, held;
  std::array<double, kMaxMemberships> values;
  std::array<double, kMaxRules> shares;
  standardise(raw, linear.data(), held.data());
  share(held.data(), values.data(), shares.data());
  double sum = 0;
  const double* p = consequents.data();
  for (std::size_t r = 0; r < rules.size(); ++r, p += inputs.size() + 1) {
    double rule = p[inputs.size()];
    for (std::size_t k = 0; k < inputs.size(); ++k) rule += p[k] * linear[k];
    sum += shares[r] * rule;
  }
  return output_mean + output_scale * sum;
}

}  // namespace dashpot
