#include "dashpot/base/any_number.h"

#include <cmath>
#include <limits>

namespace dashpot {

Value any_number(double number) {
  if (std::isfinite(number)) return number;
  return std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf";
}

double read_any_number(const Value& value) {
  using Limits = std::numeric_limits<double>;
  if (value.kind() == Value::Kind::String) {
    if (value.as_string() == "inf") return Limits::infinity();
    if (value.as_string() == "-inf") return -Limits::infinity();
    if (value.as_string() == "nan") return Limits::quiet_NaN();
  }
  return value.as_number();
}

}  // namespace dashpot
