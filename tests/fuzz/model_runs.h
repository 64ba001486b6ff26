#pragma once
#include <vector>

#include "dashpot/damper_model.h"

/// A run that begins at rest ends in a number or is known to have diverged.
inline void require_runs(const dashpot::DamperModel& model) {
  std::vector<double> state(model.state_size());
  dashpot::DamperInput before{};
  model.rest(before, state);
  for (const dashpot::DamperInput now :
       {dashpot::DamperInput{1e-4, 0.1, 0.5}, {2e-4, -0.1, 1}, {0, 1e3, -1e3}}) {
    model.advance(before, now, 1e-3, state);
    before = now;
    (void)model.force(now, state);
    (void)model.has_diverged(state);
  }
}
