#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace dashpot {

/// Walks the sizes and dimensions that a MAT file of version 4 or 5 states and compares them with
/// the bytes that are there, since the MAT library believes them. `bytes`: the whole file. Throws
/// Error(file, ...) on a file that is cut off, damaged or unpacks, all variables together, to far
/// more than a recording of its size.
void check_mat(std::string_view bytes, const std::string& file);

/// Bytes at the start of a version 7.3 file that hold its length.
inline constexpr std::size_t kMat73Head = 512 + 64;

/// Version 7.3 is HDF5, which checks its own structure, but a file that was cut off reads as an
/// empty one: compares the length that its superblock states with the bytes that are there.
void check_mat73(std::string_view head, std::uintmax_t file_size, const std::string& file);

}  // namespace dashpot
