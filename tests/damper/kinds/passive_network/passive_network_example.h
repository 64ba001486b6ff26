#pragma once
#include <algorithm>
#include <cmath>

#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/passive_network/passive_network_model.h"
#include "dashpot/damper/kinds/passive_network/train_passive_network.h"

/// Three springs, two memories, four neurons and three of the viscous term, with lag, inertia and
/// displacement; random numbers, those of the networks `spread`
/// beside where training starts. A
/// force of some 1 kN.
inline dashpot::PassiveNetwork example_passive_network(std::uint64_t seed = 1,
                                                       double spread = 0.5) {
  dashpot::PassiveNetwork network;
  network.sizes = {.springs = 3, .memories = 2, .neurons = 4, .viscous_neurons = 3};
  network.lags = network.inert = true;
  network.displacement_mean = 0.001;
  network.displacement_scale = 0.007;
  network.displacement_low = -2;
  network.displacement_high = 2;
  network.velocity_scale = 0.1;
  network.velocity_low = -3;
  network.velocity_high = 3;
  network.force_scale = 500;
  network.model_step = 0.002;
  initialise(network, seed);
  dashpot::Random random(seed + 1000);
  const dashpot::PassiveLayout at(network.sizes);
  for (std::size_t k = 0; k < network.numbers.size(); ++k)
    network.numbers[k] =
        k < at.first_positive()
            ? network.numbers[k] + spread * random.normal()
            : network.numbers[k] * std::exp(std::min(spread, 0.7) * random.normal());
  return network;
}
