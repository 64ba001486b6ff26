#pragma once
#include <filesystem>
#include <string>

#include "dashpot/base/store.h"
#include "studies/family/family_network.h"

namespace dashpot {

/// Finished trainings of the family study in one file, so that an interrupted study goes on where
/// it stopped. A training is found again only for the same program, data and key. Safe from several
/// threads.
class TrainingStore {
 public:
  static constexpr StoreFormat kFormat{"training", 2,
                                       "remove this file: its trainings are made again"};

  /// Opens the file or makes it, as Store does. program: differs from one build of the program to
  /// the next.
  TrainingStore(const std::filesystem::path& path, const std::string& program,
                const std::vector<Record>& data);

  /// Fills parameters, history and time of a network whose layers and scales are set. False when
  /// there is no such training, or when what was kept cannot be read: it is made again.
  bool load(const std::string& key, StudiedNetwork& network) const;
  /// Throws Error when the disk cannot take it.
  void save(const std::string& key, const StudiedNetwork& network);
  std::size_t dropped() const { return store_.dropped(); }  ///< as Store has it

 private:
  std::string basis_;  ///< of all keys: a hash of program and data
  Store store_;
};

}  // namespace dashpot
