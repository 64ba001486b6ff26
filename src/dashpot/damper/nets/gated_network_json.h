#pragma once
#include "dashpot/damper/nets/gated_network.h"
#include "dashpot/value.h"

namespace dashpot {

/// Adds a network's keys to the object of a member: signals, neurons, gates, output_scale.
void add_network(Value& member, const GatedNetwork& network);
/// Reads what add_network wrote. Whether the parts fit together is for require_sound() to say.
GatedNetwork read_network(ObjectReader& member, std::size_t currents);

}  // namespace dashpot
