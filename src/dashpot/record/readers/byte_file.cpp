#include "dashpot/record/readers/byte_file.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

#include <sys/stat.h>

#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::size_t kKept = std::size_t{1} << 13, kSmallPiece = kKept / 4;

}  // namespace

ByteFile::ByteFile(const std::filesystem::path& path)
    : path_(path.string()), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  struct stat about;
  const bool is_file =
      descriptor_ >= 0 && fstat(descriptor_, &about) == 0 && S_ISREG(about.st_mode);
  if (is_file) {
    size_ = static_cast<std::uint64_t>(about.st_size);
    return;
  }
  if (descriptor_ >= 0) close(descriptor_);
  throw Error(path_, "cannot be read as a file");
}

ByteFile::~ByteFile() { close(descriptor_); }

void ByteFile::read(std::uint64_t offset, void* to, std::size_t count) const {
  if (offset > size_ || count > size_ - offset)
    throw Error(path_,
                "is cut off or damaged: it refers to byte " +
                    std::to_string(offset > size_ ? offset : offset + count) + " of " +
                    std::to_string(size_),
                "copy it again from its source");

  if (count > kSmallPiece) return read_directly(offset, static_cast<char*>(to), count);

  // A small piece comes out of the block that is kept: of the whole file, where that is small.
  if (offset < kept_at_ || offset + count > kept_at_ + kept_.size()) {
    const std::uint64_t from = size_ <= kKept ? 0 : offset;
    std::string block(static_cast<std::size_t>(std::min<std::uint64_t>(kKept, size_ - from)), '\0');
    read_directly(from, block.data(), block.size());
    kept_ = std::move(block);
    kept_at_ = from;
  }
  std::copy_n(kept_.data() + (offset - kept_at_), count, static_cast<char*>(to));
}

void ByteFile::read_directly(std::uint64_t offset, char* to, std::size_t count) const {
  while (count > 0) {
    const ssize_t got = pread(descriptor_, to, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw Error(path_, "cannot be read to its end", "copy it again from its source");
    to += got, offset += static_cast<std::uint64_t>(got), count -= static_cast<std::size_t>(got);
  }
}

std::string ByteFile::bytes(std::uint64_t offset, std::size_t count) const {
  if (offset > size_ || count > size_ - offset) read(offset, nullptr, count);  // the message
  std::string bytes(count, '\0');
  read(offset, bytes.data(), count);
  return bytes;
}

}  // namespace dashpot
