#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/table.h"

namespace dashpot {

/// A format for CONTRIBUTING.md: the word "pairs", then as many times and forces as follow.
bool is_pairs_example(const std::filesystem::path& path, std::string_view extension,
                      std::string_view head);
std::vector<RawTable> read_pairs_example(const std::filesystem::path& path);

}  // namespace dashpot
