#pragma once
#include <cmath>

#include "dashpot/damper/inverse/network_presets.h"

/// A preset's network with weights that no training gave: to be run, saved and read.
inline dashpot::InverseNetwork example_network(const dashpot::InverseNetworkPreset& preset) {
  using namespace dashpot;
  InverseNetwork network{.name = std::string(preset.name), .taps = preset.taps, .mlp = {}};
  network.mlp.layers = {preset.taps.size(), preset.hidden.front(), 1};
  initialise(network.mlp, 1);
  for (std::size_t k = 0; k < preset.taps.size(); ++k) {
    constexpr double kScales[] = {0.01, 0.1, 1000, 0.3};  // m, m/s, N, A
    network.mlp.input_mean.push_back(1e-3 / 3);
    network.mlp.input_scale.push_back(kScales[static_cast<std::size_t>(preset.taps[k].signal)]);
  }
  network.mlp.output_mean = 0.5;
  network.mlp.output_scale = 0.3;
  return network;
}
