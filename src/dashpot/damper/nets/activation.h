#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace dashpot {

enum class Activation : std::uint8_t { Identity, Relu, Tanh, Sigmoid };

/// "identity", "relu", "tanh", "sigmoid".
std::string_view name_of(Activation activation);
/// Throws Error(where, ...) that names the known ones.
Activation activation_named(std::string_view name, const std::string& where);

}  // namespace dashpot
