#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/damper/kinds/family/family_force.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::size_t kField = 0, kFluid = 1, kGap = 2, kLength = 3;

// Field up to the third order, alone and with the fluid; geometry to the first, alone, with fluid
// or field: nine geometries do not tell more.
constexpr std::array<std::array<int, FamilyGates::kQuantities>, FamilyGates::kGates> kExponents{
    {{0, 0, 0, 0},
     {1, 0, 0, 0},
     {2, 0, 0, 0},
     {3, 0, 0, 0},
     {0, 1, 0, 0},
     {1, 1, 0, 0},
     {2, 1, 0, 0},
     {0, 0, 1, 0},
     {0, 0, 0, 1},
     {0, 1, 1, 0},
     {0, 1, 0, 1},
     {1, 0, 1, 0},
     {1, 0, 0, 1}}};

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

void require_sound(const FamilyGates& gates, const std::string& where) {
  const std::vector<double> rates = gates.bank.rates();
  const auto all_positive = [](const auto& values) {
    return std::ranges::all_of(values, is_positive);
  };
  if (!gates.bank.current_rates.empty())
    throw Error(where, "has current rates", "the field is not lagged");

  // Rates, speeds and scales are divided by.
  if (!all_positive(rates)) throw Error(where, "a rate is not a positive number");
  if (!all_positive(gates.soft_speeds)) throw Error(where, "a soft speed is not a positive number");
  if (!is_positive(gates.half_current)) throw Error(where, "half_current is not a positive number");
  if (!all_positive(gates.scale) || !all_positive(gates.term_scale))
    throw Error(where, "a scale is not a positive number");

  // The lists must be as long as the terms are many.
  if (gates.term_count() > FamilyGates::kMaxTerms)
    throw Error(where, "has " + std::to_string(gates.term_count()) + " terms",
                "at most " + std::to_string(FamilyGates::kMaxTerms));
  if (gates.term_scale.size() != gates.term_count())
    throw Error(where, "has " + std::to_string(gates.term_scale.size()) + " scales",
                "one for each of the " + std::to_string(gates.term_count()) + " terms");
  if (const std::size_t wanted = gates.term_count() * FamilyGates::kGates;
      gates.weights.size() != wanted)
    throw Error(where, "has " + std::to_string(gates.weights.size()) + " weights",
                "its terms and gates need " + std::to_string(wanted));
}

}  // namespace

std::span<const std::array<int, FamilyGates::kQuantities>> FamilyGates::exponents() {
  return kExponents;
}

void FamilyGates::read_terms(const DamperInput& input, std::span<const double> state,
                             double* terms) const noexcept {
  bank.read(input, state, terms);
  terms += bank.signal_count();
  for (const double speed : soft_speeds) *terms++ = std::tanh(input.velocity / speed);
  *terms = 1;
}

FamilyGates::Quantities FamilyGates::quantities(const FamilyMember& member,
                                                double current) const noexcept {
  // Saturating as equation 8 of the family paper.
  const double i = std::min(std::abs(current), 1e6 * half_current);
  Quantities q{};
  q[kField] = i / (i + half_current);
  q[kFluid] = std::log(member.viscosity);
  q[kGap] = member.gap;
  q[kLength] = member.pole_length;
  for (std::size_t n = 0; n < kQuantities; ++n) q[n] = (q[n] - mean[n]) / scale[n];
  return q;
}

std::array<double, FamilyGates::kGates> FamilyGates::gates(const Quantities& quantities) noexcept {
  std::array<double, kGates> values;
  for (std::size_t k = 0; k < kGates; ++k) {
    values[k] = 1;
    for (std::size_t n = 0; n < kQuantities; ++n)
      for (int power = 0; power < kExponents[k][n]; ++power) values[k] *= quantities[n];
  }
  return values;
}

GatedFamily::GatedFamily(FamilyGates gates, const std::string& where) : gates_(std::move(gates)) {
  require_sound(gates_, where);
}

std::size_t GatedFamily::parameter_count() const noexcept { return gates_.weights.size(); }

void GatedFamily::rest(const DamperInput& input, std::span<double> state) const noexcept {
  gates_.bank.rest(input, state);
}

void GatedFamily::advance(const FamilyMember&, const DamperInput& from, const DamperInput& to,
                          double dt, std::span<double> state) const noexcept {
  gates_.bank.advance(from, to, dt, state);
}

void GatedFamily::settle(const FamilyMember& member, const SteadySine& sine, double phase,
                         std::span<double> state) const {
  constexpr int kOfCycle = 100;
  const double part = 2 * std::numbers::pi / kOfCycle;
  rest(sine.at(phase), state);
  find_cycle(state, [&](std::span<double> cycled) {
    for (int k = 1; k <= kOfCycle; ++k)
      advance(member, sine.at(phase + (k - 1) * part), sine.at(phase + k * part), part / sine.rate,
              cycled);
  });
}

double GatedFamily::force(const FamilyMember& member, const DamperInput& input,
                          std::span<const double> state) const noexcept {
  std::array<double, FamilyGates::kMaxTerms> terms;
  gates_.read_terms(input, state, terms.data());
  const auto open = FamilyGates::gates(gates_.quantities(member, input.current));
  double sum = 0;
  const double* weight = gates_.weights.data();
  for (std::size_t j = 0; j < gates_.term_count(); ++j) {
    double gate = 0;
    for (const double value : open) gate += *weight++ * value;
    sum += gate * terms[j] / gates_.term_scale[j];
  }
  return sum;
}

Value GatedFamily::to_json() const {
  const auto numbers = [](const FamilyGates::Quantities& q) {
    return Value::array(std::vector<double>(q.begin(), q.end()));
  };
  return Value::object({{"kind", "gates"},
                        {"path_rates", Value::array(gates_.bank.path_rates)},
                        {"velocity_rates", Value::array(gates_.bank.velocity_rates)},
                        {"soft_speeds", Value::array(gates_.soft_speeds)},
                        {"half_current", gates_.half_current},
                        {"mean", numbers(gates_.mean)},
                        {"scale", numbers(gates_.scale)},
                        {"term_scale", Value::array(gates_.term_scale)},
                        {"weights", Value::array(gates_.weights)}});
}

}  // namespace dashpot
