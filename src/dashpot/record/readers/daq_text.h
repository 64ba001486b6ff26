#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/table.h"

namespace dashpot {

/// The log of a data logger: "Header Size: n", that many header lines (the sampling interval among
/// them), then numbered samples with a column of events. Samples between "DAQ Resume" and "DAQ
/// Pause" are one test run each, so that one file gives several tables ("part 1", "part 2" ...).
/// The sampling interval becomes RawTable::sample_time; a file that was cut off gets a note. Throws
/// Error(file:line, ...) on a header that is incomplete.
bool is_daq_text(const std::filesystem::path& path, std::string_view extension,
                 std::string_view head);
std::vector<RawTable> read_daq_text(const std::filesystem::path& path);

}  // namespace dashpot
