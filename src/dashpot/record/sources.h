#pragma once
#include <filesystem>
#include <vector>

#include "dashpot/record/dataset_file.h"
#include "dashpot/record/source_files.h"

namespace dashpot {

/// Everything that the caller pointed at: files, and what is stated about them. The first room of
/// loading; nothing has been parsed but the dataset file.
struct Sources {
  std::vector<SourcePath> files;
  std::string pointed_at;  ///< the first path, for messages
  /// Without a path when nobody stated anything: every file is tried by its names.
  DatasetFile stated;
};

/// Separates recordings from a dataset file among the paths; without one looks for dataset.yaml in
/// the folder, then, when options.recognise, for a shipped dataset file that recognises the
/// recordings. Throws Error on paths that cannot be read and on more than one dataset file.
Sources find_sources(std::vector<std::filesystem::path> paths, const LoadOptions& options);

/// The same for each path by itself where several are given and one of them has a dataset.yaml of
/// its own; else all paths together.
std::vector<Sources> find_all_sources(const std::vector<std::filesystem::path>& paths,
                                      const LoadOptions& options);

/// The manifest beside the recordings; an empty one when there is none and none is stated. Throws
/// Error when the stated one is missing.
Manifest find_manifest(const Sources& sources);

/// Whether its name ends as that of a dataset file, .yaml or .yml, in any case.
bool is_dataset_file(const std::filesystem::path& path);

/// The first entry whose pattern fits, or nullptr.
const FileStatement* statement_for(const DatasetFile& stated, const SourcePath& file);

}  // namespace dashpot
