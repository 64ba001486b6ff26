#include "fuzz.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

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
  const auto path = folder.path / name;
  // Not write_file: waiting for the disk would take most of the time.
  std::FILE* file = std::fopen(path.c_str(), "wb");
  require_true(file && std::fwrite(content.data(), 1, content.size(), file) == content.size());
  std::fclose(file);
  return path;
}
