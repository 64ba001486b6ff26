#include "dashpot/driver.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

Driver::Driver(const DriverOptions& options) : options_(options) {
  const auto& [low, high, rate, lag, period] = options;
  if (!(std::isfinite(low) && std::isfinite(high) && low < high))
    throw Error(
        "driver",
        "the currents " + format_number(low) + " ... " + format_number(high) + " are no range",
        "give the least current first");
  if (!(rate > 0))
    throw Error("driver", "a rate limit of " + format_number(rate) + " A/s", "it must be above 0");
  if (!(lag >= 0 && std::isfinite(lag)))
    throw Error("driver", "a lag rate of " + format_number(lag) + " 1/s", "write 0 for none");
  if (!(period >= 0 && std::isfinite(period)))
    throw Error("driver", "a period of " + format_number(period) + " s", "write 0 for none");
}

void Driver::rest(double current, std::span<double> state) const noexcept {
  state[kCoil] = state[kAsked] = state[kHeld] = state[kRamp] =
      std::clamp(current, options_.current_min, options_.current_max);
  state[kWait] = 0;
}

void Driver::command(double current, std::span<double> state) const noexcept {
  if (!std::isnan(current))
    state[kAsked] = std::clamp(current, options_.current_min, options_.current_max);
  if (state[kWait] > 0) return;
  state[kHeld] = state[kAsked];
  state[kWait] = options_.period;
  follow(0, state);
}

void Driver::advance(double dt, std::span<double> state) const noexcept {
  if (options_.period == 0 && is_steady(state)) return;

  // Sums of steps miss a sampling instant by rounding: one that is nearly reached counts as
  // reached.
  const double slack = 1e-9 * options_.period;
  if (options_.period == 0 || dt < state[kWait] - slack) {
    state[kWait] = std::max(0.0, state[kWait] - dt);
    follow(dt, state);
    return;
  }
  const double rest = std::max(0.0, dt - state[kWait]);
  follow(state[kWait], state);
  if (rest > slack) state[kHeld] = state[kAsked];
  follow(rest, state);
  const double since = std::fmod(rest, options_.period);
  const bool is_instant = since <= slack || options_.period - since <= slack;
  state[kWait] = is_instant ? 0 : options_.period - since;
}

double Driver::next_corner(std::span<const double> state) const noexcept {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double sampled = state[kAsked] != state[kHeld] ? state[kWait] : kNever;
  const double way = std::abs(state[kHeld] - state[kRamp]);
  return std::min(sampled,
                  way > 0 && std::isfinite(options_.rate_max) ? way / options_.rate_max : kNever);
}

void Driver::meet_corner(std::span<double> state) const noexcept {
  if (state[kWait] < kInstant && state[kAsked] != state[kHeld]) {
    state[kWait] = 0;
    command(state[kAsked], state);
  }
  if (std::abs(state[kHeld] - state[kRamp]) < kInstant * options_.rate_max)
    state[kRamp] = state[kHeld];
}

bool Driver::is_steady(std::span<const double> state) const noexcept {
  return state[kCoil] == state[kHeld] && state[kRamp] == state[kHeld] &&
         state[kAsked] == state[kHeld];
}

void Driver::follow(double dt, std::span<double> state) const noexcept {
  const double r = options_.lag_rate;
  const double way = state[kHeld] - state[kRamp];
  const double on_ramp = std::min(dt, std::abs(way) / options_.rate_max);
  if (on_ramp > 0) {  // there the coil trails the ramp, but for a deviation that decays
    const double slope = std::copysign(options_.rate_max, way), trail = r > 0 ? slope / r : 0;
    const double deviation = (state[kCoil] - state[kRamp] + trail) * std::exp(-r * on_ramp);
    state[kRamp] += slope * on_ramp;
    state[kCoil] = state[kRamp] - trail + deviation;
  }
  if (on_ramp < dt || std::isinf(options_.rate_max)) state[kRamp] = state[kHeld];
  const double kept = r > 0 ? std::exp(-r * (dt - on_ramp)) : 0;
  state[kCoil] = state[kRamp] + kept * (state[kCoil] - state[kRamp]);
}

}  // namespace dashpot
