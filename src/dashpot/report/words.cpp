#include "dashpot/report/words.h"

#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"

namespace dashpot {

std::string percent_text(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size >= 1e6) return fmt::format("{:.1e}", value);
  if (size >= 5e-4 && size < 0.095) return format_number(value, 2);  // 0.0027 is not 0.00
  return fmt::format("{:.{}f}", value, size < 1 ? 2 : size < 100 ? 1 : 0);
}

std::string number_text(double value, int digits) {
  return std::isfinite(value) ? format_number(value, digits) : "-";
}

std::string range_text(double least, double greatest, int digits) {
  const std::string low = number_text(least, digits), high = number_text(greatest, digits);
  return low == high ? low : low + " ... " + high;
}

std::string level_text(double level, const std::string& unit) {
  return unit.empty() ? "constant drive" : format_number(level, 3) + " " + unit;
}

}  // namespace dashpot
