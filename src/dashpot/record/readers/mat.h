#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/stored_arrays.h"
#include "dashpot/record/readers/table.h"

namespace dashpot {

/// MATLAB files of versions 4, 5 (6, 7) and 7.3. Vectors, columns of matrices ("x(2)") and fields
/// of structures ("test.force") of one common length become columns; single numbers become scalars.
/// Variables of another length or kind are passed over with a note. Throws Error on a damaged file
/// and NoTable on one without arrays of numbers.
bool is_mat(const std::filesystem::path& path, std::string_view extension, std::string_view head);
std::vector<RawTable> read_mat(const std::filesystem::path& path);
/// The same of what the file holds.
std::vector<RawTable> mat_tables(StoredArrays all, const std::string& file);

}  // namespace dashpot
