#include "dashpot/base/file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <mutex>
#include <set>
#include <unistd.h>
#include <utility>
#include <vector>
#include <zlib.h>

#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/types.h>

#include "dashpot/error.h"

namespace fs = std::filesystem;

namespace dashpot {

/// A descriptor, closed at its end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }  // NOLINT(google-explicit-constructor)
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 30;  // of a file that is read at once

// What may come out of packed bytes: more than recordings do, less than fills a memory.
constexpr std::size_t kAlwaysUnpacked = std::size_t{64} << 20, kMostUnpackedPerByte = 25;

// What is kept of a file that may be packed: all of a small one.
constexpr std::size_t kLeastPacked = std::size_t{1} << 10, kMostPacked = std::size_t{1} << 18;

constexpr std::string_view kTemporaryMark = ".part-";
constexpr std::size_t kRandomLetters = 6;
constexpr std::time_t kAbandoned = 60;  // s: a file that is being written is younger, or locked

std::string reason() { return std::strerror(errno); }

/// Opens a regular file to read; opening a pipe must not wait for its writer.
int open_regular(const fs::path& path, std::size_t& size) {
  Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file < 0 && errno == ENOENT) throw Error(path.string(), "there is no such file");
  if (file < 0) throw Error(path.string(), "cannot be read: " + reason());
  struct stat about;
  if (fstat(file, &about) != 0) throw Error(path.string(), "cannot be read: " + reason());
  if (S_ISDIR(about.st_mode)) throw Error(path.string(), "is a folder, not a file");
  if (!S_ISREG(about.st_mode))
    throw Error(path.string(), "is a pipe or a device, not a file", "save its content to a file");
  size = static_cast<std::size_t>(about.st_size);
  return file.release();
}

bool is_temporary_name(const std::string& name) {
  const std::size_t ending = kTemporaryMark.size() + kRandomLetters;
  return name.size() >= ending &&
         name.compare(name.size() - ending, kTemporaryMark.size(), kTemporaryMark) == 0;
}

/// Removes a temporary file of ours whose writer is gone: a living one holds its lock, but for the
/// moment after it was made.
void remove_abandoned(const fs::path& path) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat about;
  if (file < 0 || fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) return;
  if (about.st_uid != geteuid() || std::time(nullptr) - about.st_mtime < kAbandoned) return;
  if (flock(file, LOCK_EX | LOCK_NB) == 0) unlink(path.c_str());
}

/// Once per folder and process.
void sweep_folder(const fs::path& folder) {
  static std::mutex guard;
  static std::set<fs::path> swept;
  {
    const std::lock_guard lock(guard);
    if (!swept.insert(folder).second) return;
  }
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (is_temporary_name(entry.path().filename().string())) remove_abandoned(entry.path());
}

/// A temporary file beside the final one; removed unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& final_path)
      : final_(final_path),
        folder_(final_path.has_parent_path() ? final_path.parent_path() : fs::path(".")),
        name_(
            (folder_ / (std::string(kTemporaryMark) + std::string(kRandomLetters, 'X'))).string()),
        descriptor_(mkostemp(name_.data(), O_CLOEXEC)) {
    if (descriptor_ < 0) fail();
    flock(descriptor_, LOCK_EX | LOCK_NB);
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

    // The new name must reach the disk, too; some file systems cannot be asked.
    const Descriptor folder(open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder >= 0 && fsync(folder) != 0 && errno != EINVAL && errno != ENOTSUP)
      throw Error(final_.string(), "may be lost when the machine fails: " + reason());
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(final_.string(), "cannot be written: " + reason(),
                "what stood there before is unchanged");
  }

  fs::path final_, folder_;
  std::string name_;
  int descriptor_;
  bool renamed_ = false;
};

}  // namespace

struct InputFile::State {
  explicit State(const fs::path& from)
      : path(from.string()),
        file(open_regular(from, size)),
        packed(std::clamp(size, kLeastPacked, kMostPacked)) {}

  /// Up to `room` bytes of the file as they are.
  std::size_t take(char* to, std::size_t room) {
    for (;;) {
      const ssize_t n = ::read(file, to, room);
      if (n >= 0) return static_cast<std::size_t>(n);
      if (errno != EINTR) throw Error(path, "cannot be read: " + reason());
    }
  }

  /// Looks at the first bytes, once; they stay in `packed`.
  void begin() {
    begun = true;
    while (available < packed.size()) {
      const std::size_t n = take(packed.data() + available, packed.size() - available);
      if (n == 0) break;
      available += n;
    }
    is_packed = starts_member();
    if (is_packed && inflateInit2(&stream, 15 + 16) != Z_OK) damaged("there is no memory for it");
  }

  bool starts_member() const {
    return available >= 2 && packed[next] == '\x1f' && packed[next + 1] == '\x8b';
  }

  std::size_t plain(char* to, std::size_t room) {
    if (available == 0) return take(to, room);
    const std::size_t n = std::min(room, available);
    std::copy_n(packed.data() + next, n, to);
    next += n;
    available -= n;
    return n;
  }

  /// At least `bytes` in `packed`, where the file still has them.
  void refill(std::size_t bytes) {
    if (available >= bytes) return;
    std::copy_n(packed.data() + next, available, packed.data());
    next = 0;
    while (available < bytes) {
      const std::size_t n = take(packed.data() + available, packed.size() - available);
      if (n == 0) return;
      available += n;
    }
  }

  /// Behind a member comes another, zeros that fill a block of a tape, or the end.
  bool begin_next_member() {
    refill(2);
    if (starts_member()) return inflateReset(&stream) == Z_OK;
    while (available > 0) {
      if (packed[next] != '\0') damaged("what follows its first part is no gzip");
      ++next;
      --available;
      refill(1);
    }
    return false;
  }

  std::size_t unpack(char* to, std::size_t room) {
    stream.next_out = reinterpret_cast<Bytef*>(to);
    stream.avail_out = static_cast<uInt>(std::min<std::size_t>(room, UINT_MAX));
    const uInt wanted = stream.avail_out;
    while (!at_end && stream.avail_out == wanted) {
      refill(1);
      if (available == 0) damaged("it ends too early");
      stream.next_in = reinterpret_cast<Bytef*>(packed.data() + next);
      stream.avail_in = static_cast<uInt>(available);
      const int code = inflate(&stream, Z_NO_FLUSH);
      next += available - stream.avail_in;
      available = stream.avail_in;
      if (code == Z_STREAM_END)
        at_end = !begin_next_member();
      else if (code != Z_OK && code != Z_BUF_ERROR)
        damaged(stream.msg ? stream.msg : "it cannot be unpacked");
    }

    const std::size_t got = wanted - stream.avail_out;
    unpacked += got;
    if (unpacked > most_unpacked(size))
      throw Error(
          path, "unpacks to more than " + std::to_string(kMostUnpackedPerByte) + " times its size",
          "unpack it with gunzip first, if it is what it should be");
    return got;
  }

  [[noreturn]] void damaged(const std::string& why) const {
    throw Error(path, "cannot be read: damaged gzip file: " + why, "copy it again from its source");
  }

  ~State() {
    if (is_packed) inflateEnd(&stream);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::string path;
  std::size_t size = 0;  // before `file`, which fills it in
  Descriptor file;
  std::vector<char> packed;
  std::size_t next = 0, available = 0;  // in `packed`
  bool begun = false, is_packed = false, at_end = false;
  z_stream stream{};
  std::size_t unpacked = 0;
};

InputFile::InputFile(const fs::path& path) : state_(std::make_unique<State>(path)) {}
InputFile::~InputFile() = default;

std::size_t InputFile::size() const { return state_->size; }

std::size_t InputFile::read(char* to, std::size_t room) {
  State& state = *state_;
  if (!state.begun) state.begin();
  return state.is_packed ? state.unpack(to, room) : state.plain(to, room);
}

std::size_t most_unpacked(std::size_t packed) {
  return std::max(kAlwaysUnpacked, kMostUnpackedPerByte * packed);
}

std::string read_head(const fs::path& path, std::size_t bytes) {
  InputFile file(path);
  std::string head(bytes, '\0');
  std::size_t at = 0;
  while (at < bytes) {
    const std::size_t n = file.read(head.data() + at, bytes - at);
    if (n == 0) break;
    at += n;
  }
  head.resize(at);
  return head;
}

std::string read_file(const fs::path& path) {
  InputFile file(path);
  std::string content;
  std::array<char, 1 << 16> block;
  while (const std::size_t n = file.read(block.data(), block.size())) {
    content.append(block.data(), n);
    if (content.size() > kMostBytes)
      throw Error(path.string(), "holds more than 1 GiB", "divide it into several files");
  }
  return content;
}

MemoryFile::MemoryFile() : descriptor_(memfd_create("dashpot", MFD_CLOEXEC)) {
  if (descriptor_ < 0) throw Error("memory", "holds no file: " + reason());
}

MemoryFile::~MemoryFile() { close(descriptor_); }

std::string MemoryFile::name() const {
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(descriptor_);
}

void MemoryFile::write(std::string_view content) const {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw Error("memory", "takes no file: " + reason());
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string MemoryFile::content() const {
  const off_t size = lseek(descriptor_, 0, SEEK_END);
  std::string bytes(static_cast<std::size_t>(std::max<off_t>(size, 0)), '\0');
  std::size_t at = 0;
  while (at < bytes.size()) {
    const ssize_t n =
        pread(descriptor_, bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw Error("memory", "cannot be read: " + reason());
    at += static_cast<std::size_t>(n);
  }
  return bytes;
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw Error(path.string(), "cannot make this folder: " + error.message());
}

void require_writable(const fs::path& path) {
  // Neither a device nor a folder must give way to a file.
  std::error_code none;
  const fs::file_status there = fs::symlink_status(path, none);
  const bool is_other = fs::exists(there) && !fs::is_regular_file(there) && !fs::is_symlink(there);
  if (is_other || !path.has_filename())
    throw Error(path.string(), "cannot be written: it is no regular file",
                "name a file that may be replaced");

  // Missing folders are made, in the nearest one that is there.
  fs::path folder = path.parent_path();
  while (!folder.empty() && !fs::exists(folder, none)) folder = folder.parent_path();
  if (folder.empty()) folder = ".";
  if (!fs::is_directory(folder, none))
    throw Error(path.string(), "cannot be written: " + folder.string() + " is no folder",
                "name a file in a folder");
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error(path.string(), "cannot be written: " + reason(), "a folder of your own");
}

void write_file(const fs::path& path, std::string_view content) {
  require_writable(path);
  if (path.has_parent_path()) make_folder(path.parent_path());

  TemporaryFile file(path);
  file.write(content);
  file.rename_to_final();
  sweep_folder(path.has_parent_path() ? path.parent_path() : fs::path("."));
}

void visit_bytes(const fs::path& path, const std::function<void(std::string_view)>& visit) {
  std::size_t size = 0;
  const Descriptor file(open_regular(path, size));
  std::array<char, 1 << 16> block;
  ssize_t n;
  while ((n = read(file, block.data(), block.size())) > 0)
    visit({block.data(), static_cast<std::size_t>(n)});
  if (n < 0) throw Error(path.string(), "cannot be read: " + reason());
}

}  // namespace dashpot
