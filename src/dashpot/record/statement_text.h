#pragma once
#include <filesystem>
#include <string>

#include "dashpot/dataset.h"

namespace dashpot {

/// The dataset file that states what was understood of these recordings, to be corrected by hand:
/// for every file its columns with unit, scale, offset and sign, its time, level and condition.
/// Files that differ in nothing share an entry. The recordings read by it are the same records,
/// cuts, filters and roles of an earlier dataset file apart. `folder`: that of the recordings, as
/// they were loaded from; `beside`: the folder in which the text will lie.
std::string statement_text(const Dataset& dataset, const std::filesystem::path& folder,
                           const std::filesystem::path& beside);

/// The keys of the entry that states what was understood of one file, as YAML indented by four
/// spaces: all of the entry but its 'match'.
std::string file_statement_text(const Dataset& dataset, const std::string& file);

}  // namespace dashpot
