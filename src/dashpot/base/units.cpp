#include "dashpot/base/units.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

struct Named {
  std::string_view name;
  Dimension dimension;  // kg, m, s, A, K
  double factor;
  double offset = 0;
};

constexpr Dimension kNone{}, kLength{0, 1}, kTime{0, 0, 1}, kForce{1, 1, -2}, kPressure{1, -1, -2},
    kVoltage{1, 2, -3, -1}, kTemperature{0, 0, 0, 0, 1};
constexpr double kStandardGravity = 9.80665;
constexpr double kPi = 3.14159265358979323846;

constexpr Named kUnits[] = {
    {"1", kNone, 1},
    {"-", kNone, 1},
    {"%", kNone, 0.01},
    {"rad", kNone, 1},
    {"deg", kNone, kPi / 180},
    {"m", kLength, 1},
    {"in", kLength, 0.0254},
    {"inch", kLength, 0.0254},
    {"inches", kLength, 0.0254},
    {"ft", kLength, 0.3048},
    {"feet", kLength, 0.3048},
    {"metre", kLength, 1},
    {"meter", kLength, 1},
    {"s", kTime, 1},
    {"sec", kTime, 1},
    {"second", kTime, 1},
    {"min", kTime, 60},
    {"h", kTime, 3600},
    {"Hz", {0, 0, -1}, 1},
    {"g", {1}, 1e-3},
    {"t", {1}, 1e3},
    {"N", kForce, 1},
    {"newton", kForce, 1},
    {"kgf", kForce, kStandardGravity},
    {"kp", kForce, kStandardGravity},
    {"lbf", kForce, 4.4482216152605},
    {"lb", kForce, 4.4482216152605},
    {"lbs", kForce, 4.4482216152605},
    {"daN", kForce, 10},
    {"g0", {0, 1, -2}, kStandardGravity},
    {"Pa", kPressure, 1},
    {"cP", {1, -1, -1}, 1e-3},
    {"Oe", {0, -1, 0, 1}, 1000 / (4 * kPi)},
    {"bar", kPressure, 1e5},
    {"psi", kPressure, 6894.757293168},
    {"J", {1, 2, -2}, 1},
    {"W", {1, 2, -3}, 1},
    {"T", {1, 0, -2, -1}, 1},
    {"H", {1, 2, -2, -2}, 1},
    {"ohm", {1, 2, -3, -2}, 1},
    {"A", {0, 0, 0, 1}, 1},
    {"amp", {0, 0, 0, 1}, 1},
    {"ampere", {0, 0, 0, 1}, 1},
    {"V", kVoltage, 1},
    {"volt", kVoltage, 1},
    {"K", kTemperature, 1},
    {"degC", kTemperature, 1, 273.15},
    {"C", kTemperature, 1, 273.15},
    {"celsius", kTemperature, 1, 273.15},
    {"degF", kTemperature, 5.0 / 9.0, 273.15 - 32 * 5.0 / 9.0},
    {"fahrenheit", kTemperature, 5.0 / 9.0, 273.15 - 32 * 5.0 / 9.0},
};

struct Prefix {
  std::string_view name;
  double factor;
};
constexpr Prefix kPrefixes[] = {{"k", 1e3},       {"c", 1e-2},      {"m", 1e-3},     {"u", 1e-6},
                                {"M", 1e6},       {"n", 1e-9},      {"milli", 1e-3}, {"kilo", 1e3},
                                {"\u00b5", 1e-6}, {"\u03bc", 1e-6}, {"centi", 1e-2}};

const Named* find_named(std::string_view name) {
  for (const Named& unit : kUnits)
    if (unit.name == name) return &unit;

  // Words ("Newtons", "VOLTS", "Amps") may be in any case and in the plural; symbols may not.
  std::string word = lower(name);
  for (const bool is_plural : {false, true}) {
    if (is_plural && (word.size() <= 3 || word.back() != 's')) break;
    if (is_plural) word.pop_back();
    if (word.size() < 3) break;
    for (const Named& unit : kUnits)
      if (unit.name == word) return &unit;
  }
  return nullptr;
}

std::optional<Unit> parse_symbol(std::string_view name) {
  if (const Named* unit = find_named(name))
    return Unit{unit->dimension, unit->factor, unit->offset};
  for (const Prefix& prefix : kPrefixes) {
    if (name.size() <= prefix.name.size() || name.substr(0, prefix.name.size()) != prefix.name)
      continue;
    const Named* unit = find_named(name.substr(prefix.name.size()));
    if (unit && unit->offset == 0 && unit->name != "1" && unit->name != "-" && unit->name != "%")
      return Unit{unit->dimension, unit->factor * prefix.factor, 0};
  }
  return std::nullopt;
}

/// One factor: "mm", "s^2", "s2", "cm^-2".
std::optional<Unit> parse_factor(std::string_view text) {
  // The exponent stands behind a caret, or is a last digit 2 or 3.
  int exponent = 1;
  if (const std::size_t caret = text.find('^'); caret != std::string_view::npos) {
    const auto power = parse_number(text.substr(caret + 1));
    if (!power || *power != std::round(*power) || std::abs(*power) > 9) return std::nullopt;
    exponent = static_cast<int>(*power);
    text = text.substr(0, caret);
  } else if (text.size() > 1 && text != "g0" && (text.back() == '2' || text.back() == '3')) {
    exponent = text.back() - '0';
    text.remove_suffix(1);
  }

  // An offset (degC) makes no sense in a power.
  auto unit = parse_symbol(text);
  if (!unit || (unit->offset != 0 && exponent != 1)) return std::nullopt;
  if (exponent == 1) return unit;

  // Raise dimension and factor to the power.
  Unit power{{}, std::pow(unit->factor, exponent), 0};
  for (std::size_t k = 0; k < power.dimension.size(); ++k)
    power.dimension[k] = unit->dimension[k] * exponent;
  return power;
}

/// Spells superscripts, dots and blanks between factors as ^ and *, "mm per s" as "mm/s".
std::string normalise(std::string_view text) {
  static constexpr std::pair<std::string_view, std::string_view> kSpellings[] = {
      {"\u207b\u00b9", "^-1"}, {"\u207b\u00b2", "^-2"},
      {"\u207b\u00b3", "^-3"}, {"\u00b2", "^2"},
      {"\u00b3", "^3"},        {"\u2212", "-"},
      {"\u00b7", "*"},         {"\u22c5", "*"},
      {"\u00b0", "deg"},       {"**", "^"},
      {"deg C", "degC"},       {"deg F", "degF"},
      {" per ", "/"}};
  std::string out(trim(text));
  for (const auto& [from, to] : kSpellings)
    for (std::size_t at; (at = out.find(from)) != std::string::npos;)
      out.replace(at, from.size(), to);
  for (std::size_t k = 1; k + 1 < out.size(); ++k)
    if ((out[k] == ' ' || out[k] == '.') && std::isalpha(static_cast<unsigned char>(out[k + 1])))
      out[k] = '*';
  std::erase(out, ' ');

  // "mm*s-1": an exponent without its caret, which a factor alone ("T-1", a channel) is not taken
  // to have.
  if (out.find('*') != std::string::npos)
    for (std::size_t k = 1; k + 1 < out.size(); ++k)
      if (out[k] == '-' && std::isalpha(static_cast<unsigned char>(out[k - 1])) &&
          std::isdigit(static_cast<unsigned char>(out[k + 1])))
        out.insert(k++, 1, '^');
  return out;
}

/// A product of factors, each times `sign` in the exponent.
bool multiply(Unit& unit, std::string_view product, int sign) {
  for (const std::string& part : split(product, '*')) {
    const auto factor = parse_factor(part);
    if (!factor) return false;
    for (std::size_t k = 0; k < unit.dimension.size(); ++k)
      unit.dimension[k] += sign * factor->dimension[k];
    unit.factor *= sign > 0 ? factor->factor : 1 / factor->factor;
    if (factor->offset != 0) {
      if (product.find('*') != std::string_view::npos || sign < 0) return false;
      unit.offset = factor->offset;
    }
  }
  return true;
}

/// What a number of `unit` is to be multiplied by beside its factor to count in `si_unit`: Hz
/// counts whole turns, rad/s angles, and a rate in 1/s neither, all of the same dimension.
double turns(std::string_view unit, std::string_view si_unit, const std::string& where) {
  const auto has = [&](std::string_view word) { return unit.find(word) != std::string_view::npos; };
  if (si_unit == "Hz" && (has("rad") || has("deg") || has("\u00b0"))) return 1 / (2 * kPi);
  if (si_unit == "1/s" && has("Hz"))
    throw Error(where, "'" + std::string(unit) + "' is not a unit of a rate",
                "it is counted in 1/s; that of a lag is 2 pi times its corner frequency in Hz");
  return 1;
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view text) {
  const std::string spelled = normalise(text);
  if (spelled.empty() || spelled.size() > 40) return std::nullopt;

  // Products one behind the other: the first counts, those behind a slash divide.
  Unit unit;
  std::string_view rest = spelled;
  int sign = 1;
  while (!rest.empty()) {
    std::size_t end = rest.find('/');
    std::string_view product = rest.substr(0, end);
    if (product.size() > 2 && product.front() == '(' && product.back() == ')')
      product = product.substr(1, product.size() - 2);
    if (product.empty() || !multiply(unit, product, sign)) return std::nullopt;
    if (end == std::string_view::npos) return unit;
    rest.remove_prefix(end + 1);
    sign = -1;
  }
  return std::nullopt;
}

Unit require_unit(std::string_view text, const std::string& where) {
  if (const auto unit = parse_unit(text)) return *unit;
  throw Error(where, "unknown unit '" + std::string(text) + "'",
              "write it like mm, m/s, kN, N*s/m, cm^-2, A, V, degC, in, lbf");
}

double parse_quantity(std::string_view text, std::string_view si_unit, const std::string& where) {
  const auto finite = [&](std::size_t length) {
    const auto number = parse_number(trim(text.substr(0, length)));
    return number && std::isfinite(*number) ? number : std::nullopt;
  };

  // The longest beginning that is a number is the number.
  std::size_t length = text.size();
  while (length > 0 && !finite(length)) --length;
  const std::string right = si_unit == "1"
                                ? "write it as 0.25"
                                : "a number in " + std::string(si_unit) + ", or one with its unit";
  if (length == 0) throw Error(where, "'" + std::string(text) + "' is not a number", right);
  const double number = *finite(length);

  // The rest, if any, is a unit of the dimension that is asked for.
  const std::string_view suffix = trim(text.substr(length));
  if (suffix.empty()) return number;
  const std::optional<Unit> read = parse_unit(suffix);
  if (!read)
    throw Error(where,
                "'" + std::string(text) + "' has an unknown unit '" + std::string(suffix) + "'",
                right);
  const Unit& unit = *read;
  if (unit.dimension != require_unit(si_unit, where).dimension)
    throw Error(where, "'" + std::string(suffix) + "' is not a unit of it",
                "it is counted in " + std::string(si_unit));
  return turns(suffix, si_unit, where) * unit.factor * number + unit.offset;
}

}  // namespace dashpot
