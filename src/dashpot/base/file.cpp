#include "dashpot/base/file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <unistd.h>
#include <zlib.h>

#include <sha2.h>
#include <sys/stat.h>
#include <sys/types.h>

#include "dashpot/error.h"

namespace fs = std::filesystem;

namespace dashpot {
namespace {

std::string reason() { return std::strerror(errno); }

void require_readable_file(const fs::path& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status)) throw Error(path.string(), "there is no such file");
  if (fs::is_directory(status)) throw Error(path.string(), "is a folder, not a file");
}

/// A temporary file beside the final one; removed unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& final_path)
      : final_(final_path),
        name_(final_path.string() + ".part-XXXXXX"),
        descriptor_(mkostemp(name_.data(), O_CLOEXEC)) {
    if (descriptor_ < 0) fail();
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!renamed_) unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      content.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void rename_to_final() {
    const mode_t mask = umask(0);
    umask(mask);
    if (fchmod(descriptor_, 0666 & ~mask) != 0 || fsync(descriptor_) != 0) fail();
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (close(descriptor) != 0 || rename(name_.c_str(), final_.c_str()) != 0) fail();
    renamed_ = true;
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(final_.string(), "cannot be written: " + reason(),
                "what stood there before is unchanged");
  }

  fs::path final_;
  std::string name_;
  int descriptor_;
  bool renamed_ = false;
};

}  // namespace

std::string read_file(const fs::path& path) {
  require_readable_file(path);
  // gzread passes plain files through unchanged.
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  if (!file) throw Error(path.string(), "cannot be read: " + reason());
  std::string content;
  std::array<char, 1 << 16> block;
  int n;
  while ((n = gzread(file.get(), block.data(), block.size())) > 0)
    content.append(block.data(), static_cast<std::size_t>(n));
  int code = Z_OK;
  const char* message = gzerror(file.get(), &code);
  // A truncated gzip ends with Z_BUF_ERROR although gzread returned 0.
  if (n < 0 || code == Z_BUF_ERROR) {
    throw Error(path.string(),
                code == Z_ERRNO ? "cannot be read: " + reason()
                                : std::string("damaged gzip file: ") + message,
                "copy it again from its source");
  }
  return content;
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw Error(path.string(), "cannot make this folder: " + error.message());
}

void write_file(const fs::path& path, std::string_view content) {
  if (path.has_parent_path()) make_folder(path.parent_path());
  TemporaryFile file(path);
  file.write(content);
  file.rename_to_final();
}

std::string sha256(std::string_view bytes) {
  std::array<char, SHA256_DIGEST_STRING_LENGTH> text;
  SHA256Data(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), text.data());
  return text.data();
}

std::string sha256_of_file(const fs::path& path) {
  require_readable_file(path);
  std::array<char, SHA256_DIGEST_STRING_LENGTH> text;
  if (!SHA256File(path.c_str(), text.data()))
    throw Error(path.string(), "cannot be read: " + reason());
  return text.data();
}

}  // namespace dashpot
