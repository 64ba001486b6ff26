#pragma once
#include <string>

#include "command.h"
#include "dashpot/base/print_units.h"

namespace dashpot::cli {

/// The row of the units in which forces and motions are shown.
Option units_option(std::string& units);

/// Those of screens and pages: as stated, else N, mm and mm/s. Throws UsageError on what names
/// none.
PrintUnits page_units(const std::string& stated);
/// Those of CSV files: as stated, else SI.
PrintUnits file_units(const std::string& stated);

}  // namespace dashpot::cli
