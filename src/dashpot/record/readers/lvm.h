#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/table.h"

namespace dashpot {

/// LabVIEW's measurement in text: a header of the file, then segments, each with a header of its
/// own (channels, units, start and step of X), the names of the columns, samples and a column of
/// comments. A segment that goes on where the one before ends continues its table; another one is
/// a part of its own. An X that is a time becomes a column "time" in s, or RawTable::sample_time
/// where the file holds no X. Throws Error(file:line, ...) on a header that is cut off, on channels
/// with starts or steps of their own, and on a file without samples.
bool is_lvm(const std::filesystem::path& path, std::string_view extension, std::string_view head);
std::vector<RawTable> read_lvm(const std::filesystem::path& path);

}  // namespace dashpot
