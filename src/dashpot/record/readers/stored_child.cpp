#include <csignal>
#include <cstring>
#include <unistd.h>

#include "dashpot/base/child_process.h"
#include "dashpot/base/data_folder.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/stored_arrays.h"

// Alone in its file: the fuzzers, which look for faults, read in their own process instead; see
// tests/fuzz/hdf5_in_process.cpp.

namespace fs = std::filesystem;

namespace dashpot {
namespace {

/// Why the process that reads a file has not handed it over to its end.
[[noreturn]] void refuse_stored(const std::string& file, const std::string& library,
                                const ChildStatus& end) {
  const std::string copy = "copy it again from its source";
  const char* known = sigdescr_np(end.signal);
  const std::string signal =
      "signal " + std::to_string(end.signal) + (known ? " (" + std::string(known) + ")" : "");
  switch (end.was_ended ? 0 : end.signal) {
    case SIGSEGV:
    case SIGBUS:
    case SIGFPE:
    case SIGILL:
    case SIGABRT:
    case SIGTRAP:
    case SIGSYS:
      throw Error(
          file,
          "is damaged: the " + library + " library was ended by " + signal + " while reading it",
          copy);
    case SIGXCPU:
      throw Error(file,
                  "is damaged: the " + library +
                      " library took more time to read it than any file of its size needs",
                  copy);
    case 0:
      break;
    default:
      throw Error(file, "was not read to its end: its reader was ended from outside by " + signal,
                  "read it again, with more memory if that was short");
  }

  // With sanitizers each fault of the library ends so.
  std::string how = "ended before it had handed over all";
  if (end.was_ended) how = "handed over what is no recording";
  if (end.exit_status >= 0) how = "ended with status " + std::to_string(end.exit_status);
  throw Error(file, "was not read to its end: dashpot-hdf5, which reads it, " + how,
              copy + "; where all files of its kind are refused, install Dashpot anew");
}

}  // namespace

StoredArrays read_stored_arrays(const fs::path& path, StoredFormat format) {
  const bool is_mat = format == StoredFormat::Mat;
  HandingChild child({own_program("dashpot-hdf5").string(), is_mat ? "read-mat" : "read-hdf5",
                      path.string(), std::to_string(getpid())});

  StoredArrays all;
  const auto take = [&](void* to, std::size_t count) { return child.take(to, count); };
  const bool is_whole = take_stored_arrays(take, 2 * most_stored_bytes(fs::file_size(path)), all);
  char more;
  const bool is_all = is_whole && child.take(&more, 1) == 0;
  if (const ChildStatus end = child.wait(); !is_all)
    refuse_stored(path.string(), is_mat ? "MAT" : "HDF5", end);
  return all;
}

}  // namespace dashpot
