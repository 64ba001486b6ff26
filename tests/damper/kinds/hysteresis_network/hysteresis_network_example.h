#pragma once
#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"

/// Two Dahl states, a velocity lag, a current lag and three neurons of random weights; a force of
/// some 1 kN.
inline dashpot::HysteresisNetwork example_hysteresis_network(std::uint64_t seed = 1) {
  dashpot::HysteresisNetwork model;
  model.bank = {.path_rates = {60, 500}, .velocity_rates = {60}, .current_rates = {50}};
  model.network.signals = {
      {0, 0.2, -3, 3}, {0, 1, -1, 1}, {0, 1, -1, 1}, {0, 0.1, -3, 3}, {1, 1, -1, 1}};
  model.network.currents = 1;
  model.network.initialise(3, seed);
  dashpot::Random random(seed + 100);
  for (double& weight : model.network.gates) weight = 0.5 * random.normal();
  model.network.output_scale = 1000;
  return model;
}
