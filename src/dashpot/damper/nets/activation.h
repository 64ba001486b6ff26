#pragma once
#include <string>
#include <string_view>

#include "dashpot/fit_choices.h"

namespace dashpot {

/// "identity", "relu", "tanh", "sigmoid".
std::string_view name_of(Activation activation);
/// Throws Error(where, ...) that names the known ones.
Activation activation_named(std::string_view name, const std::string& where);

}  // namespace dashpot
