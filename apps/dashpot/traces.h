#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/base/print_units.h"
#include "dashpot/evaluate.h"

namespace dashpot::cli {

/// --traces FORMAT.
Option traces_option(std::string& format);

/// Records in that format, a file each and all in one for "raw"; `units` are of CSV alone.
void write_records(const std::vector<Record>& records, const std::string& format,
                   const PrintUnits& units, const std::filesystem::path& folder);

/// Motion, drive, and the forces measured, modelled and between them, likewise.
/// Returns how many records were written.
std::size_t write_traces(const std::vector<RecordResult>& results, DriveUnit drive_unit,
                         const std::string& format, const PrintUnits& units,
                         const std::filesystem::path& folder);

}  // namespace dashpot::cli
