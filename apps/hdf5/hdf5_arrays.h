#pragma once
#include <filesystem>

#include "dashpot/record/readers/stored_arrays.h"

namespace dashpot {

/// Hands over the datasets of numbers of each group, of up to two dimensions and kMostMatrixColumns
/// columns; a note tells of every other one. Throws Error on damage and on what check_hdf5 refuses.
void hand_over_hdf5(const std::filesystem::path& path, StoredWriter& to);

}  // namespace dashpot
