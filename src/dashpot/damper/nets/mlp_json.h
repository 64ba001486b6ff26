#pragma once
#include <string>

#include "dashpot/damper/nets/mlp.h"
#include "dashpot/value.h"

namespace dashpot {

/// Adds a network's layers, activations (where they are not the usual ones), scales and weights to
/// an object.
void add_mlp(Value& object, const Mlp& mlp);
/// Reads what add_mlp wrote. Its shape is still to be checked.
Mlp read_mlp(ObjectReader& reader);

/// Throws Error(where, ...) where layers, weights and scales are not those of a network with so
/// many inputs and one output.
void require_shape(const Mlp& mlp, std::size_t inputs, const std::string& where);

}  // namespace dashpot
