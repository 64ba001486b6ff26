#include "dashpot/damper/inverse/numeric.h"

#include <math.h>  // the C texts say fabs, not std::fabs

namespace dashpot {
namespace {

struct SearchError {
  const Observer* observer;
  const InverseInput* input;
  double* state;
};

// The functions that the C texts below call.

using RootError = SearchError;
inline double root_error(const RootError* e, double current) {
  return e->observer->force(current, *e->input, {e->state, e->observer->state_size()}) -
         e->input->wanted;
}
inline void observer_follow(const Observer* m, const InverseInput* input, double* state) {
  m->follow(*input, {state, m->state_size()});
}
constexpr double ROOT_NARROW = 1e-12;

// clang-format off: the second builds on the first
#include "dashpot/damper/c_text/root_search.h"
#include "dashpot/damper/c_text/inverse_search.h"
// clang-format on

}  // namespace

NumericInverse::NumericInverse(const DamperModel& forward, const InverseLimits& limits)
    : InverseModel(limits), observer_(forward, limits) {}

void NumericInverse::rest(const DamperInput& input, std::span<double> state) const noexcept {
  observer_.rest(input, state);
  state[observer_.state_size()] = input.current;
  state[observer_.state_size() + 1] = 0;
}

double NumericInverse::wanted_current(const InverseInput& input,
                                      std::span<double> state) const noexcept {
  const SearchNumbers numbers{limits().current_min, limits().current_max, negligible()};
  return search_wanted(&observer_, &numbers, &input, state.data(), &state[observer_.state_size()]);
}

}  // namespace dashpot
