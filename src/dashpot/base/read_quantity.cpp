#include "dashpot/base/read_quantity.h"

#include <cmath>

#include "dashpot/base/units.h"
#include "dashpot/error.h"

namespace dashpot {

double read_quantity(const Value& value, std::string_view si_unit) {
  const double number = value.kind() == Value::Kind::Number
                            ? value.as_number()
                            : parse_quantity(value.as_string(), si_unit, value.where());
  if (!std::isfinite(number)) throw Error(value.where(), "is not finite", "a number");
  return number;
}

}  // namespace dashpot
