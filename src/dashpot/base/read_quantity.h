#pragma once
#include <string_view>

#include "dashpot/value.h"

namespace dashpot {

/// A number, which is in the SI unit, or text with a unit of its own: 0.004, "4 mm". Throws Error
/// where it is neither, or not finite.
double read_quantity(const Value& value, std::string_view si_unit);

}  // namespace dashpot
