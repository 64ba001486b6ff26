#pragma once
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

#include "dashpot/base/error.h"
#include "dashpot/base/file.h"
#include "dashpot/record/dataset.h"

// What the fuzz targets share. dashpot::Error is the right answer to bad input; all else is a finding.

/// A folder of this process, in memory where there is room for it, removed at the end.
struct FuzzFolder {
  std::filesystem::path path;
  FuzzFolder() {
    const bool has_memory = std::filesystem::is_directory("/dev/shm");
    path = (has_memory ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path()) /
           ("dashpot-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(path);
  }
  ~FuzzFolder() { std::filesystem::remove_all(path); }
};

inline std::filesystem::path fuzz_file(const std::string& name, const std::string& content) {
  static const FuzzFolder folder;
  const auto path = folder.path / name;
  // Not write_file: waiting for the disk would take most of the time.
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file || std::fwrite(content.data(), 1, content.size(), file) != content.size()) std::abort();
  std::fclose(file);
  return path;
}

/// What every dataset keeps: one sample per stamp, finite, in increasing time.
inline void require_sound(const dashpot::Dataset& dataset) {
  for (const dashpot::Record& record : dataset.records) {
    if (record.size() < 2 || !record.find("force") || !record.find("velocity")) std::abort();
    for (std::size_t k = 1; k < record.size(); ++k)
      if (!(record.time[k] > record.time[k - 1])) std::abort();
    for (const dashpot::Channel& channel : record.channels) {
      if (channel.samples.size() != record.size()) std::abort();
      for (const double value : channel.samples)
        if (!std::isfinite(value)) std::abort();
    }
  }
}

/// Loads a file as the command line would, by its name.
inline void load_fuzzed(const std::filesystem::path& path, const std::string& dataset_file = {}) {
  dashpot::LoadOptions options;
  options.recognise = false;
  options.dataset_file = dataset_file;
  const dashpot::Dataset dataset = dashpot::load_dataset({path}, options);
  require_sound(dataset);
  dashpot::describe(dataset);
}

void fuzz(const std::string& input);  // each target defines it

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    fuzz(std::string(reinterpret_cast<const char*>(data), size));
  } catch (const dashpot::Error&) {
  }
  return 0;
}
