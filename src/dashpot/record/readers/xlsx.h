#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/table.h"

namespace dashpot {

/// A workbook in Office Open XML (ECMA-376): .xlsx and .xlsm, by its beginning and its name.
bool is_xlsx(const std::filesystem::path& path, std::string_view extension, std::string_view head);

/// Reads each sheet that holds a table, as if it had been saved as CSV: names, units, junk lines,
/// clock times and cells that are no numbers are understood by csv.h. Of formulas the kept values
/// are taken. Hidden sheets, sheets without numbers and sheets that are short beside another (less
/// than a tenth of its rows) are passed over, with a note. Throws Error on damage, and NoTable when
/// no sheet holds numbers.
std::vector<RawTable> read_xlsx(const std::filesystem::path& path);

}  // namespace dashpot
