// Layer: base
#pragma once

// Tables of parameters: one row for each number that a plant, a road, a controller or an excitation
// takes. Defaults, bounds, help and the parsing of texts all come from the row. SI.

#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dashpot {

/// One parameter of a sequence, a plant, a controller or a road.
struct ParameterRow {
  std::string_view name, unit;
  double value = 0, lower = 0, upper = 0;  ///< default and bounds
  std::string_view meaning;
  bool whole = false;  ///< a count
};
using ParameterTable = std::span<const ParameterRow>;

/// Values by name, SI.
using NamedValues = std::vector<std::pair<std::string, double>>;

/// The default of each row, in the order of the table.
std::vector<double> default_values(ParameterTable table);

/// The place of the row of that name. Throws Error(where, "AM has no parameter 'amplitud'", ...),
/// `owner` being AM.
std::size_t row_named(ParameterTable table, std::string_view name, std::string_view owner,
                      const std::string& where);
/// The value unchanged. Throws Error(where, "amplitude is 3 m", "between 0 and 1") outside the
/// row's bounds.
double checked(const ParameterRow& row, double value, const std::string& where);
/// "4mm", "4 mm" or "0.004", which is in the row's unit, checked.
double parse_value(const ParameterRow& row, std::string_view text, const std::string& where);

/// The defaults with these values in their places, checked; likewise from texts "amplitude=4mm".
/// Throws Error(where, ...) as row_named() and checked() do.
std::vector<double> with_values(ParameterTable table, const NamedValues& values,
                                std::string_view owner, const std::string& where);
std::vector<double> parse_values(ParameterTable table, std::span<const std::string> texts,
                                 std::string_view owner, const std::string& where);

/// "AM: amplitude 0.025 m, carrier 2 Hz"
std::string describe_values(ParameterTable table, std::span<const double> values,
                            std::string_view owner);

/// Values in table order as the struct of doubles whose fields stand in that order.
template <class P>
P values_as(std::span<const double> values) {
  P own;
  static_assert(sizeof own % sizeof(double) == 0);
  std::memcpy(&own, values.data(), sizeof own);
  return own;
}

}  // namespace dashpot
