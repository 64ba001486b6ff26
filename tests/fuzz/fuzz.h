#pragma once
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// What the fuzz targets share. dashpot::Error is the right answer to bad input; all else is a
// finding.

/// Something that takes text or bytes from outside, under a name. Makes itself known where it is
/// defined.
class FuzzTarget {
 public:
  using Function = void (*)(const std::string& input);
  FuzzTarget(std::string_view name, Function function);

  std::string_view name() const { return name_; }
  /// Throws nothing but what is a finding.
  void run(const std::string& input) const;

 private:
  std::string_view name_;
  Function function_;
};

/// In alphabetical order.
std::vector<const FuzzTarget*> fuzz_targets();
/// nullptr when there is none of that name.
const FuzzTarget* find_fuzz_target(std::string_view name);

/// Writes small valid inputs of every target into folders below this one: where fuzzing starts.
void write_seeds(const std::filesystem::path& folder);
void write_word_seeds(const std::filesystem::path& folder);
void write_store_seeds(const std::filesystem::path& folder);

/// Ends the process as a finding where what must hold does not.
inline void require_true(bool holds) {
  if (!holds) std::abort();
}

/// Words may name files: none that never end.
inline bool names_a_device(const std::string& words) {
  return words.find("/dev") != std::string::npos || words.find("/proc") != std::string::npos;
}

/// A file with this content in a folder of this process, in memory where there is room for it.
std::filesystem::path fuzz_file(const std::string& name, const std::string& content);
