#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dashpot {

/// The dampers of a night of production, in the order of their serial numbers.
///
/// The rule: where the folder has subfolders, each of them is one damper with all recordings that
/// lie in it, and other files are passed over. Where it has none, each file is one damper. Names
/// that begin with a dot and a dataset.yaml of the folder itself are no dampers; that dataset.yaml
/// says how the recordings of every damper are read that has none of its own.
///
/// The serial number of a damper is the last number in its name (of a file, before the ending).
/// Where a name has none, or two dampers have the same, all are numbered from 1 on in the order of
/// their names.
struct DamperFolders {
  std::filesystem::path folder;
  std::vector<std::string> names;        ///< of the subfolders or files
  std::vector<double> serials;           ///< ascending, one per name
  bool has_serials = false;              ///< they come from the names
  std::filesystem::path statement;       ///< the folder's dataset.yaml; empty: none
  std::vector<std::string> passed_over;  ///< files beside the subfolders

  /// The dataset.yaml by which the damper's recordings are read; empty: what lies beside them.
  std::filesystem::path statement_of(std::size_t damper) const;
  std::filesystem::path path_of(std::size_t damper) const { return folder / names[damper]; }
  /// The names and contents of all files that the damper's rows come from, as a hash. Throws Error
  /// where one cannot be read.
  std::string content_of(std::size_t damper) const;
};

/// Throws Error where the folder cannot be read or holds no damper.
DamperFolders find_dampers(const std::filesystem::path& folder);

}  // namespace dashpot
