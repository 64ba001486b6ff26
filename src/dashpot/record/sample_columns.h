#pragma once
#include <filesystem>
#include <vector>

#include "dashpot/dataset.h"

namespace dashpot {

/// Time and every channel of these records as plain numbers, for programs that draw:
/// `folder`/samples.f64 holds the columns one after the other (doubles, little-endian), and
/// `folder`/samples.json which column begins where: {"records": [{"name", "source", "samples",
/// "columns": [{"name", "unit", "origin", "at"}]}]}, `at` counted in doubles. The JSON also lists
/// what is `unread` and `suspect` of `dataset`, where one is given.
void write_sample_columns(const std::vector<Record>& records, const std::filesystem::path& folder,
                          const Dataset* dataset = nullptr);

}  // namespace dashpot
