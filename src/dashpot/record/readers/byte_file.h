#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>

namespace dashpot {

/// A regular file that is read at any place, by one thread.
class ByteFile {
 public:
  /// Throws Error when it cannot be opened.
  explicit ByteFile(const std::filesystem::path& path);
  ~ByteFile();
  ByteFile(const ByteFile&) = delete;
  ByteFile& operator=(const ByteFile&) = delete;

  /// Fills `to` with `count` bytes from `offset` on. Throws Error where the file ends before.
  void read(std::uint64_t offset, void* to, std::size_t count) const;
  std::string bytes(std::uint64_t offset, std::size_t count) const;
  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }

 private:
  void read_directly(std::uint64_t offset, char* to, std::size_t count) const;

  std::string path_;
  std::uint64_t size_ = 0;
  int descriptor_;
  mutable std::string kept_;  ///< a block, since small pieces lie side by side
  mutable std::uint64_t kept_at_ = 0;
};

/// The number whose bytes begin at `from`, the least or the most significant first.
template <class Number>
Number number_at(const void* from, bool big_endian = false) {
  unsigned char bytes[sizeof(Number)];
  std::memcpy(bytes, from, sizeof(Number));
  if (big_endian != (std::endian::native == std::endian::big))
    for (std::size_t k = 0; k < sizeof(Number) / 2; ++k)
      std::swap(bytes[k], bytes[sizeof(Number) - 1 - k]);
  Number value;
  std::memcpy(&value, bytes, sizeof(Number));
  return value;
}

}  // namespace dashpot
