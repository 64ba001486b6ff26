#include "dashpot/damper/inverse/inverse.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"

namespace dashpot {

InverseModel::InverseModel(const InverseLimits& limits) : limits_(limits) {
  const auto& [low, high, sample_time, lag_rate] = limits;
  if (!(std::isfinite(low) && std::isfinite(high) && low < high))
    throw Error("inverse",
                "the currents " + format_number(low) + " ... " + format_number(high) + " are no range",
                "give the least current first");
  if (!(sample_time > 0 && std::isfinite(sample_time) && lag_rate >= 0 && std::isfinite(lag_rate)))
    throw Error("inverse", "the sample time must be above 0, and the lag rate 0 or above");
  lead_ = lag_rate > 0 ? -1 / std::expm1(-lag_rate * sample_time) : 1;
}

double InverseModel::clamped(double current) const noexcept {
  return current > limits_.current_min ? std::min(current, limits_.current_max) : limits_.current_min;
}

double InverseModel::command(const InverseInput& input, std::span<double> state) const noexcept {
  const double held = clamped(input.current);
  for (const double value : {input.wanted, input.displacement, input.velocity, input.current, input.measured})
    if (!std::isfinite(value)) return held;
  const double current = wanted_current(input, state);
  if (std::isnan(current)) return held;
  return clamped(held + lead_ * (clamped(current) - held));
}

}  // namespace dashpot
