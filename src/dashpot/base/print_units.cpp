#include "dashpot/base/print_units.h"

#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr Dimension kForceDimension{1, 1, -2}, kLengthDimension{0, 1};

/// A part of --units as a unit of the dimension that stands there.
PrintUnit part_of(std::string_view name, const Dimension& dimension, const std::string& where,
                  const std::string& remedy) {
  const Unit unit = require_unit(name, where);
  if (unit.dimension != dimension)
    throw Error(where, "'" + std::string(name) + "' stands in the wrong place", remedy);
  return {std::string(name), 1 / unit.factor};
}

}  // namespace

PrintUnits PrintUnits::si() {
  PrintUnits units;
  units.length_ = {"m", 1};
  return units;
}

PrintUnits PrintUnits::parse(std::string_view text, const std::string& where) {
  const std::string remedy = "a unit of force and a length per second, as N,mm/s or lbf,in/s";
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 2 || !trim(parts[1]).ends_with("/s"))
    throw Error(where, "'" + std::string(text) + "' names no units of force and speed", remedy);
  std::string_view length = trim(parts[1]);
  length.remove_suffix(2);
  PrintUnits units;
  units.force_ = part_of(trim(parts[0]), kForceDimension, where, remedy);
  units.length_ = part_of(length, kLengthDimension, where, remedy);
  return units;
}

PrintUnit PrintUnits::of(std::string_view si_unit) const {
  if (si_unit == "N") return force_;
  if (si_unit == "m") return length_;
  if (si_unit == "m/s") return {length_.name + "/s", length_.factor};
  if (si_unit == "N/m") return {force_.name + "/" + length_.name, force_.factor / length_.factor};

  // What is not read off beside a force or a stroke stays with metres where these are metric.
  const bool is_metric = length_.name.ends_with('m');
  const PrintUnit length = is_metric ? PrintUnit{"m", 1} : length_;
  for (const std::string_view rate : {"/s^2", "/s^1.75"})
    if (si_unit.starts_with('m') && si_unit.substr(1) == rate)
      return {length.name + std::string(rate), length.factor};
  if (si_unit == "N*s/m") {
    const std::string space = is_metric ? "" : " ";
    return {force_.name + space + "s/" + length.name, force_.factor / length.factor};
  }
  if (si_unit == "J" || si_unit == "W") {
    const bool has_name = is_metric && force_.name.ends_with('N') && force_.name != "daN";
    if (has_name)
      return {force_.name.substr(0, force_.name.size() - 1) + std::string(si_unit), force_.factor};
    return {force_.name + " " + length.name + (si_unit == "W" ? "/s" : ""),
            force_.factor * length.factor};
  }
  return {std::string(si_unit), 1};
}

}  // namespace dashpot
