#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/record/build_record.h"

namespace dashpot {

/// A file's name taken apart: "sine_5mm_3Hz_0.25A" -> 0.25 A and "sine_5mm_3Hz". No level when no
/// number has the unit A, mA, V or mV. "0,25A" and "0p25A" are 0.25 A. A level whose text may mean
/// two numbers ("0_5A", "05A") has a doubt. The folders of the path speak where the name is silent.
struct NameParts {
  std::optional<KnownLevel> level;
  std::string rest;
};
NameParts split_name(std::string_view stem);

/// The same for one of several sheets or groups that a file names: their names speak before the
/// file's, and may have a blank before the unit, "0.5 A".
NameParts split_part_name(std::string_view stem, std::string_view part);

/// "I=0.5" of "run_I=0.5_f=1Hz": a word of a file's or a folder's name that is the symbol of a
/// current or a voltage and a number without a unit, which may be its level; "" where there is
/// none.
std::string level_without_unit(std::string_view name);

/// The level that the name of a folder states, with the words "folder name" as its basis.
std::optional<KnownLevel> level_of_folder(std::string_view name);

/// Gives every record without a condition one: the rest of its name when that states a motion (mm,
/// Hz), else amplitude and frequency; records within 5 % of each other share one. A bare number in
/// a name that is the record's drive level ("test_4mm_4Hz_0.5" at 0.5 A) is no part of the motion,
/// nor is what counts records that move alike ("07_sine_5mm_3Hz", "sine_5mm_3Hz_rep2").
void infer_conditions(std::vector<Record>& records, const std::vector<std::string>& name_rests);

}  // namespace dashpot
