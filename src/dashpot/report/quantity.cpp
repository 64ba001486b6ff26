#include "dashpot/report/quantity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

// Between two marks: style, unit, digits and numbers, apart by a third sign. Names from outside
// that hold such signs can at worst become a number.
constexpr char kMark = '\x1d', kBetween = '\x1f';

enum class Style : char {
  Name = 'u',
  Digits = 'd',
  Plain = 'p',
  Fixed = 'f',
  Signed = 's',
  Range = 'r'
};

std::string carried(Style style, std::string_view si_unit, int digits,
                    const std::vector<double>& values) {
  if (std::ranges::any_of(values, [](double value) { return !std::isfinite(value); })) return "-";
  std::string text{kMark, static_cast<char>(style), kBetween};
  text += std::string(si_unit) + kBetween + std::to_string(digits);
  for (const double value : values) text += kBetween + format_exact(value);
  return text + kMark;
}

/// Decimals that keep the resolution of so many in SI.
int decimals_in(const PrintUnit& unit, int decimals) {
  constexpr double kSlack = 1e-9;  // of powers of ten
  return std::max(0, decimals + static_cast<int>(std::ceil(-std::log10(unit.factor) - kSlack)));
}

/// What stands between two marks; nothing where it is not what carried() writes.
std::optional<std::string> shown(std::string_view inside, const PrintUnits& units) {
  const std::vector<std::string> parts = split(inside, kBetween);
  if (parts.size() < 3 || parts[0].size() != 1) return std::nullopt;
  const Style style{parts[0][0]};
  const PrintUnit unit = units.of(parts[1]);
  const auto digits = parse_number(parts[2]);
  if (!digits || !(*digits >= 0 && *digits <= 17)) return std::nullopt;
  std::vector<double> values;
  for (std::size_t k = 3; k < parts.size(); ++k) {
    const auto value = parse_number(parts[k]);
    if (!value) return std::nullopt;
    values.push_back(unit.factor * *value);
  }

  const auto wanted = static_cast<int>(*digits);
  if (values.size() != (style == Style::Name ? 0U : style == Style::Range ? 2U : 1U))
    return std::nullopt;
  switch (style) {
    case Style::Name:
      return unit.name;
    case Style::Digits:
      return number_text(values[0], wanted);
    case Style::Plain:
      return format_plain(values[0], wanted);
    case Style::Fixed:
      return fmt::format("{:.{}f}", values[0], decimals_in(unit, wanted));
    case Style::Signed:
      return fmt::format("{:+.{}f}", values[0], decimals_in(unit, wanted));
    case Style::Range:
      return range_text(values[0], values[1], wanted);
  }
  return std::nullopt;
}

}  // namespace

std::string quantity(double value, std::string_view si_unit, int digits) {
  return carried(Style::Digits, si_unit, digits, {value});
}
std::string plain_quantity(double value, std::string_view si_unit, int digits) {
  return carried(Style::Plain, si_unit, digits, {value});
}
std::string fixed_quantity(double value, std::string_view si_unit, int decimals) {
  return carried(Style::Fixed, si_unit, decimals, {value});
}
std::string signed_quantity(double value, std::string_view si_unit, int decimals) {
  return carried(Style::Signed, si_unit, decimals, {value});
}
std::string quantity_range(double least, double greatest, std::string_view si_unit, int digits) {
  return carried(Style::Range, si_unit, digits, {least, greatest});
}
std::string unit_name(std::string_view si_unit) { return carried(Style::Name, si_unit, 0, {}); }

std::string in_units(std::string_view text, const PrintUnits& units) {
  std::string result;
  while (true) {
    // Up to the next mark the text stands as it is; so does a mark that carries nothing.
    const std::size_t open = text.find(kMark);
    result += text.substr(0, open);
    if (open == std::string_view::npos) return result;
    const std::size_t close = text.find(kMark, open + 1);
    const auto number = close == std::string_view::npos
                            ? std::nullopt
                            : shown(text.substr(open + 1, close - open - 1), units);
    result += number ? *number : std::string(1, kMark);
    text.remove_prefix(number ? close + 1 : open + 1);
  }
}

}  // namespace dashpot
