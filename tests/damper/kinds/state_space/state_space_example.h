#pragma once
#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/state_space/state_space_model.h"

/// Two path states, a lag, a current lag, three neurons in the cell and two that read it, random
/// weights; a force of some 1 kN.
inline dashpot::StateSpaceNetwork example_state_space(std::uint64_t seed = 1) {
  dashpot::StateSpaceNetwork model;
  model.cell = {.path_rates = {12, 100},
                .lag_rates = {60},
                .current_rates = {50},
                .velocity_scale = 0.2,
                .velocity_low = -3,
                .velocity_high = 3,
                .current_mean = 1,
                .model_step = 0.002};
  model.cell.initialise(3, seed);
  dashpot::Random random(seed + 100);
  for (double& weight : model.cell.feedback) weight = 0.2 * random.normal();
  model.network.signals = {
      {0, 0.2, -3, 3}, {0, 1, -1, 1}, {0, 1, -1, 1}, {0, 1, -3, 3}, {0, 1, -1, 1}};
  model.network.currents = 1;
  model.network.initialise(2, seed);
  for (double& weight : model.network.gates) weight = 0.5 * random.normal();
  model.network.output_scale = 1000;
  return model;
}
