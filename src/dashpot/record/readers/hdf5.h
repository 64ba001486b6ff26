#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/stored_arrays.h"
#include "dashpot/record/readers/table.h"

namespace dashpot {

/// A file of HDF5 that is no MAT file: .h5, .hdf5 and others by its beginning.
bool is_hdf5(const std::filesystem::path& path, std::string_view extension, std::string_view head);

/// Reads each group: its datasets of the commonest length are the columns of a table, by their
/// names, in the units of their attributes "unit" or "units"; a matrix of up to 64 columns is as
/// many of them, "F(1)"; single numbers stand beside the table. Texts, compounds and arrays of more
/// dimensions are passed over with a note. Throws Error on damage, on numbers that lie in other
/// files or are far more than a file of its size has, and NoTable when no group holds numbers.
std::vector<RawTable> read_hdf5(const std::filesystem::path& path);
/// The same of what the file holds.
std::vector<RawTable> hdf5_tables(StoredArrays all, const std::string& file);

}  // namespace dashpot
