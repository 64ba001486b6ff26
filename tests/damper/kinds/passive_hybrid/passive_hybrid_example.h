#pragma once
#include "damper/kinds/passive_network/passive_network_example.h"
#include "dashpot/damper/kinds/passive_hybrid/passive_hybrid_model.h"
#include "dashpot/damper/parameter_set.h"

/// A published modified Bouc-Wen damper and the mean of two random networks beside it.
inline dashpot::PassiveHybridModel example_passive_hybrid(double network_share = 0.3,
                                                          double offset = 2) {
  return {dashpot::load_parameters("spencer1997"),
          {"passive_network", {example_passive_network(1), example_passive_network(2)}},
          network_share,
          offset};
}
