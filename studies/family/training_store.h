#pragma once
#include <filesystem>
#include <string>

#include "studies/family/family_network.h"

namespace dashpot {

/// Finished trainings of a study in a folder, one file each, so that an interrupted study goes on
/// where it stopped. One is found again only for the same program, data and key.
class TrainingStore {
 public:
  /// program: what tells one build of the program from the next.
  TrainingStore(std::filesystem::path folder, std::string program, const std::vector<Record>& data);

  /// Fills parameters, history and time of a network whose layers and scales stand. False when
  /// there is no such training, or when its file cannot be read as one.
  bool load(const std::string& key, StudiedNetwork& network) const;
  /// Throws Error when the folder cannot take it.
  void save(const std::string& key, const StudiedNetwork& network) const;

 private:
  std::filesystem::path file_of(const std::string& key) const;
  std::filesystem::path folder_;
  std::string basis_;
};

}  // namespace dashpot
