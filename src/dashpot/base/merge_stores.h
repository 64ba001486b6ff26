#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/base/store.h"

namespace dashpot {

/// Two results of one task that differ, in words: "training_rmse is 12.1 and 12.2". Empty where
/// they are the same but for what no result depends on, such as the time that was spent.
using StoreDifference = std::function<std::string(std::string_view a, std::string_view b)>;

struct MergeReport {
  std::size_t results = 0;   ///< in the joined store
  std::size_t repeated = 0;  ///< found again in a further store
  std::size_t dropped = 0;   ///< damaged ones, left out
};

/// Joins stores of one format and basis into `target`, of which the results that it holds before
/// are a part. The file appears whole or, where this throws, stays as it was. Throws Error where a
/// store cannot be used, is of another basis, or disagrees with another one on a task: with the
/// task, both values and both files.
MergeReport merge_stores(const std::vector<std::filesystem::path>& sources,
                         const std::filesystem::path& target, const StoreFormat& format,
                         const StoreDifference& difference);

/// The difference of results that are texts of JSON, of which `seconds` does not count.
std::string json_difference(std::string_view a, std::string_view b);

}  // namespace dashpot
