#include "fuzz.h"

#include <algorithm>
#include <fcntl.h>
#include <map>
#include <unistd.h>
#include <utility>

#include <sys/stat.h>

#include "dashpot/error.h"

namespace {

std::vector<const FuzzTarget*>& known() {
  static std::vector<const FuzzTarget*> targets;
  return targets;
}

/// Removed at the end.
struct FuzzFolder {
  std::filesystem::path path;
  FuzzFolder() {
    const bool has_memory = std::filesystem::is_directory("/dev/shm");
    path =
        (has_memory ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path()) /
        ("dashpot-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(path);
  }
  ~FuzzFolder() { std::filesystem::remove_all(path); }
};

}  // namespace

/// C libraries meet a malloc that fails, as they would; `new` of so much is a finding.
extern "C" const char* __asan_default_options() {
  return "max_allocation_size_mb=2048:allocator_may_return_null=1";
}

/// HDF5 1.10 reads some bytes beyond an attribute that lies about its size: nothing before it can
/// tell.
extern "C" const char* __asan_default_suppressions() { return "interceptor_via_lib:libhdf5"; }

/// HDF5 keeps some memory of files that it refused.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

FuzzTarget::FuzzTarget(std::string_view name, Function function)
    : name_(name), function_(function) {
  known().push_back(this);
}

void FuzzTarget::run(const std::string& input) const {
  try {
    function_(input);
  } catch (const dashpot::Error&) {
  }
}

std::vector<const FuzzTarget*> fuzz_targets() {
  std::ranges::sort(known(), {}, &FuzzTarget::name);
  return known();
}

const FuzzTarget* find_fuzz_target(std::string_view name) {
  const auto found = std::ranges::find(known(), name, &FuzzTarget::name);
  return found == known().end() ? nullptr : *found;
}

std::filesystem::path fuzz_file(const std::string& name, const std::string& content) {
  static const FuzzFolder folder;
  static std::map<std::string, int> descriptors;
  auto path = folder.path / name;

  // Written in place as long as it is the file of that name: to open it takes longer.
  const auto [at, is_new] = descriptors.try_emplace(name, -1);
  int& file = at->second;
  struct stat about;
  if (!is_new && fstat(file, &about) == 0 && about.st_nlink == 0) close(std::exchange(file, -1));
  if (file < 0) file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);

  // Not write_file: waiting for the disk would take most of the time.
  const auto size = static_cast<ssize_t>(content.size());
  require_true(pwrite(file, content.data(), content.size(), 0) == size);
  require_true(ftruncate(file, size) == 0);
  return path;
}
