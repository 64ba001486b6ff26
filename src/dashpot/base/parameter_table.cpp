#include "dashpot/parameter_table.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

std::string with_unit(double value, const ParameterRow& row) {
  return format_number(value) + (row.unit == "1" ? "" : " " + std::string(row.unit));
}

}  // namespace

std::vector<double> default_values(ParameterTable table) {
  std::vector<double> values;
  for (const ParameterRow& row : table) values.push_back(row.value);
  return values;
}

std::size_t row_named(ParameterTable table, std::string_view name, std::string_view owner,
                      const std::string& where) {
  const auto found = std::ranges::find(table, name, &ParameterRow::name);
  if (found != table.end()) return static_cast<std::size_t>(found - table.begin());
  if (table.empty())
    throw Error(where, std::string(owner) + " has no parameter '" + std::string(name) + "'",
                "it has none at all");
  std::vector<std::string> known;
  for (const ParameterRow& row : table) known.emplace_back(row.name);
  throw Error(where, std::string(owner) + " has no parameter '" + std::string(name) + "'",
              suggest(name, known));
}

double checked(const ParameterRow& row, double value, const std::string& where) {
  if (!(value >= row.lower && value <= row.upper))
    throw Error(where, std::string(row.name) + " is " + with_unit(value, row),
                "between " + format_number(row.lower) + " and " + with_unit(row.upper, row));
  if (row.whole && value != std::round(value))
    throw Error(where, std::string(row.name) + " is " + format_number(value), "a whole number");
  return value;
}

double parse_value(const ParameterRow& row, std::string_view text, const std::string& where) {
  return checked(row, parse_quantity(text, row.unit, where + ", " + std::string(row.name)), where);
}

std::vector<double> with_values(ParameterTable table, const NamedValues& values,
                                std::string_view owner, const std::string& where) {
  std::vector<double> numbers = default_values(table);
  for (const auto& [name, value] : values) {
    const std::size_t place = row_named(table, name, owner, where);
    numbers[place] = checked(table[place], value, where);
  }
  return numbers;
}

std::vector<double> parse_values(ParameterTable table, std::span<const std::string> texts,
                                 std::string_view owner, const std::string& where) {
  std::vector<double> numbers = default_values(table);
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw Error(where, "'" + text + "' states no value", "write NAME=VALUE");
    const std::size_t place = row_named(table, trim(text.substr(0, equals)), owner, where);
    numbers[place] =
        parse_value(table[place], trim(std::string_view(text).substr(equals + 1)), where);
  }
  return numbers;
}

std::string describe_values(ParameterTable table, std::span<const double> values,
                            std::string_view owner) {
  std::string text(owner);
  for (std::size_t k = 0; k < values.size(); ++k)
    text +=
        (k == 0 ? ": " : ", ") + std::string(table[k].name) + " " + with_unit(values[k], table[k]);
  return text;
}

}  // namespace dashpot
