#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "dashpot/base/result_file.h"
#include "dashpot/evaluate.h"

namespace dashpot {

/// A design fitted on the training part of one fold and run on what is left out of it.
struct FoldResult {
  std::string failure;         ///< why there is no model; empty: there is one
  std::size_t parameters = 0;  ///< fitted numbers of the model
  ErrorSums sums;              ///< over the left-out records
  double worst_esr = 0;        ///< %, worst left-out record
  std::size_t diverged = 0;    ///< left-out records
  double seconds = 0;          ///< CPU time
};

/// Results of a search in one file, each written as it comes and never again. Safe from several
/// threads.
class TrialStore {
 public:
  /// What a result belongs to. share: of the full effort, 0 ... 1.
  struct Key {
    std::string design;
    double share;
    std::size_t fold;
  };

  /// Opens the file or makes it. `search`: all that its results depend on besides their keys.
  /// Throws Error when the file holds another search (naming what differs), is in use, is something
  /// else or is damaged.
  TrialStore(const std::filesystem::path& path, const NamedTexts& search);

  /// Throws away what the file holds, damaged or of another search. Throws Error when it is in use.
  static void remove(const std::filesystem::path& path);

  std::optional<FoldResult> load(const Key& key) const;
  /// Throws Error when there is such a result already, or when the disk cannot take it.
  void save(const Key& key, const FoldResult& result);
  std::size_t size() const;  ///< results

 private:
  ResultFile file_;
};

}  // namespace dashpot
