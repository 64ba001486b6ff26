#include "dashpot/damper/inverse/inverse.h"

#include <cmath>
#include <math.h>  // the C text says isfinite, not std::isfinite

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

struct InverseText {
  static double wanted(const InverseModel* m, const InverseInput& input, double* state) {
    return m->wanted_current(input, {state, m->state_size()});
  }
};

namespace {

// The functions that the C text below calls.

inline double inverse_least(const InverseModel* m) { return m->limits().current_min; }
inline double inverse_most(const InverseModel* m) { return m->limits().current_max; }
inline double inverse_lead(const InverseModel* m) { return m->lead(); }
inline int inverse_has_feedback(const InverseModel* m) { return m->has_feedback() ? 1 : 0; }
inline double inverse_wanted(const InverseModel* m, const InverseInput* input, double* state) {
  return InverseText::wanted(m, *input, state);
}

#include "dashpot/damper/c_text/inverse_command.h"

}  // namespace

InverseModel::InverseModel(const InverseLimits& limits, bool has_feedback)
    : limits_(limits), has_feedback_(has_feedback) {
  const auto& [low, high, sample_time, lag_rate] = limits;
  if (!(std::isfinite(low) && std::isfinite(high) && low < high))
    throw Error(
        "inverse",
        "the currents " + format_number(low) + " ... " + format_number(high) + " are no range",
        "give the least current first");
  if (!(sample_time > 0 && std::isfinite(sample_time) && lag_rate >= 0 && std::isfinite(lag_rate)))
    throw Error("inverse", "the sample time must be above 0, and the lag rate 0 or above");
  lead_ = lag_rate > 0 ? -1 / std::expm1(-lag_rate * sample_time) : 1;
}

double InverseModel::command(const InverseInput& input, std::span<double> state) const noexcept {
  return inverse_command(this, &input, state.data());
}

}  // namespace dashpot
