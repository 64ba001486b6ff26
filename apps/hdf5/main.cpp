#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iterator>
#include <new>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>

#include <sys/prctl.h>
#include <sys/resource.h>

#include "dashpot/base/child_process.h"
#include "dashpot/error.h"
#include "hdf5_arrays.h"
#include "made_files.h"
#include "mat_arrays.h"

// dashpot-hdf5: what calls the HDF5 and the MAT library, in a process of its own, since a damaged
// file can end it, and the libraries take long to load. Dashpot starts it to read or make one file
// and takes what it hands over; see docs/decisions/025.

namespace dashpot {
namespace {

/// A limit, where none that is stricter is there. The hard one stays: at that of time there is no
/// SIGXCPU, which tells what it was.
void limit(__rlimit_resource_t what, rlim_t most) {
  rlimit now{};
  if (getrlimit(what, &now) != 0) return;
  now.rlim_cur = std::min(now.rlim_cur, most);
  setrlimit(what, &now);
}

/// What reading may take at most: whole files need a small part of it.
void limit_to_reading(std::uintmax_t file_size) {
  constexpr rlim_t kSeconds = 20, kBytesPerSecond = 1 << 20;
  limit(RLIMIT_CPU, kSeconds + file_size / kBytesPerSecond);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  // Its numbers as they are unpacked and as they are handed over, and a chunk of them.
  constexpr rlim_t kProgram = rlim_t{256} << 20, kCopies = 4;
  limit(RLIMIT_AS, kProgram + kCopies * most_stored_bytes(file_size));
#endif
  limit(RLIMIT_FSIZE, 0);  // it writes no file
  limit(RLIMIT_CORE, 0);   // nor leaves one
  prctl(PR_SET_DUMPABLE, 0);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
}

/// Hands over bytes to the process that waits for them. Where they cannot be, nobody is left to
/// tell.
class HandOver {
 public:
  void give(const void* from, std::size_t count) {
    if (used_ + count > block_.size()) flush();
    if (count > block_.size()) return write_all(static_cast<const char*>(from), count);
    std::copy_n(static_cast<const char*>(from), count, block_.data() + used_);
    used_ += count;
  }
  void flush() { write_all(block_.data(), std::exchange(used_, 0)); }

 private:
  static void write_all(const char* from, std::size_t count) {
    while (count > 0) {
      const ssize_t n = write(HandingChild::kHandOver, from, count);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) _exit(EXIT_FAILURE);
      from += n, count -= static_cast<std::size_t>(n);
    }
  }

  std::array<char, 1 << 16> block_;
  std::size_t used_ = 0;
};

std::string standard_input() {
  std::string all;
  std::array<char, 1 << 16> block;
  for (;;) {
    const ssize_t n = read(STDIN_FILENO, block.data(), block.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      throw Error("", std::string("what was asked for cannot be read: ") + strerror(errno));
    if (n == 0) return all;
    all.append(block.data(), static_cast<std::size_t>(n));
  }
}

/// One thing that it does: reads a file of that name, or makes one of what is asked for.
struct Work {
  std::string_view name;
  void (*read)(const std::filesystem::path& path, StoredWriter& to);
  std::string (*make)(UnpackedBytes request);
};
constexpr Work kWork[] = {{"read-hdf5", hand_over_hdf5, nullptr},
                          {"read-mat", hand_over_mat, nullptr},
                          {"write-hdf5", nullptr, hdf5_file},
                          {"write-mat", nullptr, mat_file}};

void do_and_hand_over(const Work& work, const std::string& file, StoredWriter& to) {
  try {
    if (work.read) {
      limit_to_reading(std::filesystem::file_size(file));
      work.read(file, to);
    } else {
      const std::string request = standard_input();
      to.file(work.make(UnpackedBytes(request)));
    }
    to.end();
  } catch (const std::bad_alloc&) {
    to.fail(work.read ? file +
                            ": takes more memory than there is for a file of its size; copy it "
                            "again from its source, or free some memory"
                      : "out of memory");
  } catch (const std::exception& error) {
    to.fail(error.what());
  }
}

}  // namespace
}  // namespace dashpot

int main(int argc, char** argv) {
  using namespace dashpot;
  const auto work = std::ranges::find(kWork, argc == 4 ? argv[1] : "", &Work::name);
  if (work == std::end(kWork)) {
    constexpr std::string_view kOwn = "dashpot-hdf5 is started by Dashpot, for one file\n";
    return write(STDERR_FILENO, kOwn.data(), kOwn.size()) < 0 ? 1 : 2;
  }

  // It ends with the process that has started it, which may have gone already.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != std::atoi(argv[3])) return EXIT_FAILURE;
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is an error

  static HandOver over;
  StoredWriter to([](const void* from, std::size_t count) { over.give(from, count); });
  do_and_hand_over(*work, argv[2], to);
  over.flush();
  _exit(EXIT_SUCCESS);  // HDF5 has an exit handler that trips over files it could not close
}
