#pragma once
#include <filesystem>

#include "dashpot/record/readers/stored_arrays.h"

namespace dashpot {

/// Hands over the real matrices of a MAT file, also those in structures of one element; a note
/// tells of every other variable. Checks sizes with mat_guard.h and hdf5_guard.h first, since the
/// MAT library believes them. Throws Error on damage.
void hand_over_mat(const std::filesystem::path& path, StoredWriter& to);

}  // namespace dashpot
