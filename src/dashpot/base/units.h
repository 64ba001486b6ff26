#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace dashpot {

/// Exponents of the SI base units kg, m, s, A, K.
using Dimension = std::array<int, 5>;

/// A unit as `value_si = factor * value + offset`.
struct Unit {
  Dimension dimension{};
  double factor = 1;
  double offset = 0;  ///< only degC and degF have one
};

/// Reads "mm", "N*s/m", "cm/s^2", "1/(m*A)", "kN", "in", "lbf", "g0", "degC", "1", "%". Also
/// accepts "N s/m", "N.s/m", "m/s²", "mm s-1", "mm per s" and the spellings "newton", "Newtons",
/// "sec", "volts", "Amps". Nothing when unknown.
std::optional<Unit> parse_unit(std::string_view text);

/// As parse_unit, but throws Error(where, ...) that names the unit and near ones.
Unit require_unit(std::string_view text, const std::string& where);

/// "1.5 mm", "5N/cm" or a plain number (in SI) in `si_unit`; in Hz, rad/s count as angles. Throws
/// Error(where, ...) on anything else: a unit of another dimension, Hz of a rate in 1/s.
double parse_quantity(std::string_view text, std::string_view si_unit, const std::string& where);

}  // namespace dashpot
