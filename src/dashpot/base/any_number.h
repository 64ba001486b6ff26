#pragma once
#include "dashpot/value.h"

namespace dashpot {

/// Numbers that may be infinite or not a number, which JSON lacks: "inf", "-inf" and "nan" are
/// text.
Value any_number(double number);
/// The number that any_number() wrote. Throws Error when the value is something else.
double read_any_number(const Value& value);

}  // namespace dashpot
