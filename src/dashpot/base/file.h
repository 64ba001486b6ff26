#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace dashpot {

/// The whole file, gunzipped when its content is gzip. Throws Error when it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Writes to a temporary name beside `path` and renames it: on any failure (disk full, no right to
/// write) throws Error and the old file stands unchanged. Makes missing folders.
void write_file(const std::filesystem::path& path, std::string_view content);

/// With all its parents; nothing happens when it is there. Throws Error when it cannot be made.
void make_folder(const std::filesystem::path& path);

/// SHA-256 of bytes and of a file's, in hexadecimal.
std::string sha256(std::string_view bytes);
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace dashpot
