#include "dashpot/damper/nets/activation.h"

#include <array>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::array<std::string_view, 4> kNames{"identity", "relu", "tanh", "sigmoid"};

}  // namespace

std::string_view name_of(Activation activation) {
  return kNames[static_cast<std::size_t>(activation)];
}

Activation activation_named(std::string_view name, const std::string& where) {
  for (std::size_t k = 0; k < kNames.size(); ++k)
    if (kNames[k] == name) return static_cast<Activation>(k);
  throw Error(where, "unknown activation '" + std::string(name) + "'",
              suggest(name, {kNames.begin(), kNames.end()}));
}

}  // namespace dashpot
