#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/table.h"

namespace dashpot {

/// A measurement in ASAM MDF 4 (4.0 to 4.2): .mf4 and .mdf by its beginning.
bool is_mdf4(const std::filesystem::path& path, std::string_view extension, std::string_view head);

/// Reads each group of channels that holds a force by its name (all groups, where none does) as a
/// table, in the physical units of the file. Streams the data: memory is what the columns need.
/// Texts, arrays, complex numbers, single bits and conversions into texts or by formulas are passed
/// over with a note; of a group with more than 64 channels only those that are known by their names
/// are read. Values of different lengths (VLSD) are passed over likewise. Samples whose
/// invalidation bit is set are NaN. Throws Error on damage, on MDF 3 and on the column-oriented
/// storage of MDF 4.2, and NoTable when no group holds numbers.
std::vector<RawTable> read_mdf4(const std::filesystem::path& path);

}  // namespace dashpot
