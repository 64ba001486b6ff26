#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/record/build_record.h"

namespace dashpot {

/// A file's name taken apart: "sine_5mm_3Hz_0.25A" -> 0.25 A and "sine_5mm_3Hz". No level when no
/// number has the unit A, mA, V or mV.
struct NameParts {
  std::optional<KnownLevel> level;
  std::string rest;
};
NameParts split_name(std::string_view stem);

/// Gives every record without a condition one: the rest of its name when that states a motion (mm,
/// Hz), else amplitude and frequency; records within 5 % of each other share one.
void infer_conditions(std::vector<Record>& records, const std::vector<std::string>& name_rests);

}  // namespace dashpot
