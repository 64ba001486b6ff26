#pragma once
#include "dashpot/damper/nets/gated_network.h"
#include "dashpot/value.h"

namespace dashpot {

/// Adds a network's keys to a member of an ensemble with states of its own.
void add_network(Value& member, const GatedNetwork& network);
GatedNetwork read_network(ObjectReader& member, std::size_t currents);

}  // namespace dashpot
