#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/drive.h"

namespace dashpot {

/// A file that the caller pointed at, alone or through its folder.
struct SourcePath {
  std::filesystem::path path;
  std::string relative;  ///< to the folder that was pointed at
  bool named = false;    ///< pointed at itself, so that it may not be passed over
};

/// The files of the paths; folders, also behind links, are searched to the bottom, sorted by name
/// with numbers in their order ("run2" before "run10"). Hidden files are left out. Throws Error on
/// a path that cannot be read and on a file that is given twice.
std::vector<SourcePath> list_files(const std::vector<std::filesystem::path>& paths);

/// Marks a folder, that of results or of truths, so that list_files() does not search it.
void mark_without_recordings(const std::filesystem::path& folder);

/// Whether a pattern with * ? [...] fits the relative path or the file's name.
bool matches(const std::string& pattern, const SourcePath& file);

/// A table of the files of a folder (manifest.csv), with a column "file" of names or of paths: it
/// selects them and states their conditions. All cells are texts until number() is asked.
class Manifest {
 public:
  Manifest() = default;
  /// Throws Error when it has no column "file".
  explicit Manifest(const std::filesystem::path& path);

  bool empty() const { return rows_.empty(); }
  const std::string& path() const { return path_; }
  bool lists(const SourcePath& file) const { return row_of(file).has_value(); }
  /// The row of a file, by its path below the manifest's folder or below the folder that was
  /// pointed at, else by its bare name.
  std::optional<std::size_t> row_of(const SourcePath& file) const;
  /// The cell of a file; nothing when the file or the column is not there.
  std::optional<std::string> cell(const SourcePath& file, const std::string& column) const;
  /// The cell as a number; throws Error naming the manifest when it is none.
  double number(const SourcePath& file, const std::string& column) const;
  /// The same of a drive level, in A or V by the unit in the column's name.
  double level(const SourcePath& file, const std::string& column) const;
  /// The first column that is a current (A) or a voltage (V) by its name, with its unit.
  std::optional<std::pair<std::string, DriveUnit>> level_column() const;
  const std::vector<std::string>& columns() const { return names_; }
  /// Whether every cell of a column that it has is a number.
  bool holds_numbers(const std::string& column) const;
  /// The rows whose file is neither among these nor beside the manifest: "'run7.csv' (line 8)".
  std::vector<std::string> missing_files(const std::vector<SourcePath>& files) const;

 private:
  std::string listed_file(std::size_t row) const;  ///< its path, with '/' and no "./"

  std::string path_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::size_t> lines_;  ///< of each row
  std::size_t file_column_ = 0;
  char decimal_ = '.';
};

}  // namespace dashpot
