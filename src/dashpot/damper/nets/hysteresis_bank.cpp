#include "dashpot/damper/nets/hysteresis_bank.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/lag.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// A stretch of motion in one direction, 1 or -1, and its length in m. Over it a Dahl state nears
/// that direction: w1 = s + (w0 - s) exp(-rho length).
struct Way {
  double direction, length;
};

struct Ways {
  Way parts[2];  // before and after the velocity changes its sign
};

/// The ways of a step in which the velocity is linear: one, or two where it changes its sign.
Ways ways_of(double from, double to, double dt) noexcept {
  if (from * to >= 0) {
    const double length = dt * (std::abs(from) / 2 + std::abs(to) / 2);
    return {{{from + to < 0 ? -1.0 : 1.0, length}, {1, 0}}};
  }
  const double turn = dt * (from / (from - to));
  return {{{from < 0 ? -1.0 : 1.0, std::abs(from) / 2 * turn},
           {to < 0 ? -1.0 : 1.0, std::abs(to) / 2 * (dt - turn)}}};
}

/// Brings a Dahl state over these ways; `slope`, unless null, is its derivative by ln rate.
void slide(const Ways& ways, double rate, double& state, double* slope) noexcept {
  for (const Way& way : ways.parts) {
    if (way.length == 0) continue;
    const double reach = rate * way.length, kept = std::exp(-reach);
    if (slope) *slope = kept * (*slope - reach * (state - way.direction));
    state = way.direction + (state - way.direction) * kept;
  }
}

}  // namespace

void HysteresisBank::require_sound(const std::string& where) const {
  for (const double rate : rates())
    if (!(rate > 0 && std::isfinite(rate))) throw Error(where, "a rate is not a positive number");
}

std::vector<double> HysteresisBank::rates() const {
  std::vector<double> all = path_rates;
  all.insert(all.end(), velocity_rates.begin(), velocity_rates.end());
  all.insert(all.end(), current_rates.begin(), current_rates.end());
  return all;
}

void HysteresisBank::set_rates(std::span<const double> rates) {
  for (std::vector<double>* part : {&path_rates, &velocity_rates, &current_rates}) {
    std::copy_n(rates.begin(), part->size(), part->begin());
    rates = rates.subspan(part->size());
  }
}

void HysteresisBank::rest(const DamperInput& input, std::span<double> state) const noexcept {
  const auto currents = state.last(current_rates.size());
  std::fill(state.begin(), state.end(), 0.0);
  std::fill(currents.begin(), currents.end(), input.current);
}

void HysteresisBank::advance(const DamperInput& from, const DamperInput& to, double dt,
                             std::span<double> state, std::span<double> slopes) const noexcept {
  if (!(dt > 0)) return;
  double* at = state.data();
  double* slope = slopes.empty() ? nullptr : slopes.data();
  const auto next = [&] { return slope ? slope++ : nullptr; };
  const Ways ways = ways_of(from.velocity, to.velocity, dt);
  for (const double rate : path_rates) slide(ways, rate, *at++, next());
  for (const double rate : velocity_rates)
    advance_lag(from.velocity, to.velocity, rate * dt, *at++, next());
  for (const double rate : current_rates)
    advance_lag(from.current, to.current, rate * dt, *at++, next());
}

void HysteresisBank::flow(const DamperInput& input, std::span<const double> state,
                          std::span<double> rates) const noexcept {
  const double *at = state.data(), v = input.velocity;
  double* out = rates.data();
  for (const double rate : path_rates) *out++ = rate * (v - std::abs(v) * *at++);
  for (const double rate : velocity_rates) *out++ = rate * (v - *at++);
  for (const double rate : current_rates) *out++ = rate * (input.current - *at++);
}

void HysteresisBank::read(const DamperInput& input, std::span<const double> state,
                          double* signals) const noexcept {
  const auto lags = state.subspan(path_rates.size(), velocity_rates.size());
  const auto currents = state.last(current_rates.size());
  *signals++ = input.velocity;
  for (const double w : state.first(path_rates.size())) *signals++ = w;
  for (const double y : lags) *signals++ = input.velocity - y;
  for (const double u : currents) *signals++ = u;
}

}  // namespace dashpot
