#pragma once
#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/parameter_set.h"

/// A published modified Bouc-Wen damper, a bank of one state of each kind and three neurons of
/// random weights on top, of some 100 N.
inline dashpot::HybridModel example_hybrid(std::uint64_t seed = 1) {
  dashpot::HybridSource source{dashpot::load_parameters("spencer1997"), {{100}, {50}, {30}}};
  const std::size_t motions = source.motions();
  dashpot::Random random(seed);
  dashpot::SignalMixing mixing{std::vector<double>(motions, 0.01), {}};
  for (std::size_t row = 0; row < motions; ++row)
    for (std::size_t column = 0; column <= row; ++column)
      mixing.rows.push_back((column == source.force_place() ? 1e-3 : 1) *
                            (1 + 0.1 * random.normal()));
  dashpot::GatedNetwork network;
  network.signals.resize(motions + 2);
  network.currents = 2;
  network.initialise(3, seed);
  for (double& weight : network.gates) weight = 0.5 * random.normal();
  network.output_scale = 100;
  return {std::move(source), std::move(mixing), std::move(network)};
}
