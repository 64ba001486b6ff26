#pragma once
#include <string>

#include "dashpot/dataset.h"

namespace dashpot {

/// The dataset file that states what was understood of these recordings, to be corrected by hand:
/// for every file its columns with unit, scale, offset and sign, its time, level and condition.
/// Files that differ in nothing share an entry. The recordings read by it are the same records,
/// cuts, filters and roles of an earlier dataset file apart. `root`: their folder, seen from the
/// new file.
std::string statement_text(const Dataset& dataset, const std::string& root);

}  // namespace dashpot
