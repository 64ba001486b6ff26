#pragma once
#include <initializer_list>
#include <string>
#include <string_view>

#include "dashpot/value.h"

namespace dashpot {

/// Throws Error that names all of these keys that an object lacks at once, where a reader by itself
/// would name the first. `what` names the object in the message: "a plant".
void require_keys(const Value& object, const std::string& what,
                  std::initializer_list<std::string_view> keys);

}  // namespace dashpot
