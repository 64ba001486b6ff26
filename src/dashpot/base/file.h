#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace dashpot {

/// A file that is read block by block, gunzipped on the way when its content is gzip. Only a
/// regular file is one: a pipe or a device, which might never end, is refused at once.
class InputFile {
 public:
  /// Throws Error when it cannot be opened.
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Fills `to` with up to `room` bytes and returns how many; 0 at the end. Throws Error where the
  /// file cannot be read, is damaged or unpacks to far more than any recording of its size.
  std::size_t read(char* to, std::size_t room);
  std::size_t size() const;  ///< bytes on the disk

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// How many bytes a packed file or a part of one may unpack to: more is an attack on memory or
/// time, no recording.
std::size_t most_unpacked(std::size_t packed);

/// The first bytes of a file, gunzipped. Throws Error when it cannot be opened.
std::string read_head(const std::filesystem::path& path, std::size_t bytes);

/// The whole file, gunzipped when its content is gzip. Throws Error when it cannot be read or
/// holds more than any file that is read at once.
std::string read_file(const std::filesystem::path& path);

/// Throws Error where write_file(path) would be refused for what is there: a device or a folder in
/// the file's place, a file in a folder's, or a folder in which nothing may be made. Makes nothing:
/// for what takes long, before it.
void require_writable(const std::filesystem::path& path);

/// The one way in which Dashpot writes files: to a private temporary name beside `path`, to the
/// disk, and renamed. On any failure (disk full, no right to write) throws Error and the old file
/// stands unchanged; a link at `path` is replaced, never followed. Makes missing folders, and
/// removes what a writer that was killed has left in this one.
void write_file(const std::filesystem::path& path, std::string_view content);

/// A file in memory, for libraries that write to names only: what they made is then checked and
/// goes through write_file. Throws Error when there is none.
class MemoryFile {
 public:
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string name() const;  ///< for this process and the programs that it starts
  std::string content() const;
  void write(std::string_view content) const;  ///< for a program that reads it

 private:
  int descriptor_;
};

/// With all its parents; nothing happens when it is there. Throws Error when it cannot be made.
void make_folder(const std::filesystem::path& path);

/// Shows the bytes of a file as they lie there, packed or not, block by block. Throws Error when it
/// cannot be read.
void visit_bytes(const std::filesystem::path& path,
                 const std::function<void(std::string_view)>& visit);

/// SHA-256 of bytes and of a file's, in hexadecimal. They stand in sha256.cpp, apart from the rest:
/// the child that reads HDF5 starts without OpenSSL.
std::string sha256(std::string_view bytes);
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace dashpot
