#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct zip;
struct zip_file;

namespace dashpot {

/// A part of a zip file that is unpacked block by block.
class PackedPart {
 public:
  /// Fills `to` with up to `room` bytes and returns how many; 0 at the end. Throws Error on a
  /// damaged part, and on one that unpacks to far more than any recording of its size.
  std::size_t read(char* to, std::size_t room);
  std::size_t size() const { return size_; }  ///< unpacked, as the file states it

 private:
  friend class PackedParts;
  PackedPart(zip_file* file, std::string place, std::size_t size, std::size_t packed);

  std::unique_ptr<zip_file, int (*)(zip_file*)> file_;
  std::string place_;
  std::size_t size_, packed_, unpacked_ = 0;
};

/// The parts of a zip file by their names. Nothing is unpacked before it is read.
class PackedParts {
 public:
  /// Throws Error when the file is no whole zip file.
  explicit PackedParts(const std::filesystem::path& path);

  bool has(const std::string& name) const;
  /// Throws Error when there is none of that name.
  PackedPart open(const std::string& name) const;
  /// A small part as a whole; "" when there is none of that name. Throws Error on one of more than
  /// 16 MiB.
  std::string text(const std::string& name) const;

 private:
  std::string path_;
  std::unique_ptr<zip, void (*)(zip*)> zip_;
};

}  // namespace dashpot
