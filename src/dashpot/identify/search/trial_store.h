#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "dashpot/base/store.h"
#include "dashpot/evaluate.h"

namespace dashpot {

/// A design, fitted on the training part of one fold and run on the records left out of it.
struct FoldResult {
  std::string failure;         ///< why there is no model; empty when there is one
  std::size_t parameters = 0;  ///< of the model, fitted
  ErrorSums sums;              ///< over the left-out records
  double worst_esr = 0;        ///< %, worst left-out record
  std::size_t diverged = 0;    ///< left-out records
  double seconds = 0;          ///< CPU time
};

/// Results of one search in a file, each written as it comes. Safe from several threads.
class TrialStore {
 public:
  static constexpr StoreFormat kFormat{"search", 2, "begin anew with --fresh"};

  /// The place of a result in its search.
  struct Key {
    std::string design;  ///< as format_design() writes it
    double share;        ///< of the full effort, 0 ... 1
    std::size_t fold;
  };

  /// Opens the file or makes it, as Store does. `search`: everything that its results depend on
  /// besides their keys, as describe_search() tells it.
  TrialStore(const std::filesystem::path& path, const NamedTexts& search);

  /// Nothing when there is no such result, or when what was kept cannot be read: it is made again.
  std::optional<FoldResult> load(const Key& key) const;
  /// Throws Error when the disk cannot take it.
  void save(const Key& key, const FoldResult& result);
  std::size_t size() const { return store_.size(); }        ///< results
  std::size_t dropped() const { return store_.dropped(); }  ///< as Store has it
  Store& store() { return store_; }                         ///< for farm_out()

 private:
  Store store_;
};

}  // namespace dashpot
