#pragma once
#include <filesystem>
#include <mutex>
#include <string>

#include "dashpot/value.h"
#include "project.h"

namespace dashpot::studio {

/// Rides that are simulated while somebody looks: `dashpot simulate` in a child, seconds each. What
/// was driven is kept in .studio/drives, the last hundred of them. Safe from several threads.
class Drives {
 public:
  explicit Drives(const Project& project) : project_(project) {}

  /// `asked`: see vehicle_words.h, with {"against": ""}: the passive reference, as `dashpot
  /// simulate --against`. Returns what `simulate --json` says with "key", to look at its traces by,
  /// "channels" ({"name", "unit"}) and "arguments", the command. Throws Error where it cannot be
  /// driven.
  Value drive(const Value& asked);

  /// The folder of samples of a drive, for SampleView: its run, then the one it is compared with.
  /// Throws Error where there is none of that key.
  std::filesystem::path traces(const std::string& key) const;

 private:
  std::filesystem::path folder() const { return project_.folder() / ".studio" / "drives"; }
  void forget_old() const;

  const Project& project_;
  std::mutex mutex_;  ///< of what follows, and of removing old ones
  int running_ = 0;
};

}  // namespace dashpot::studio
