#pragma once
#include <string>
#include <string_view>

namespace dashpot {

/// The most that one MAT file may unpack to.
inline constexpr std::size_t kLargestMat = std::size_t{1} << 29;

/// Walks the sizes and dimensions that a MAT file of version 4 or 5 states and compares them with the
/// bytes that are there, since the MAT library believes them. Throws Error(file, ...) on a file that is
/// cut off, damaged or unpacks to more than kLargestMat.
void check_mat(std::string_view bytes, const std::string& file);

}  // namespace dashpot
