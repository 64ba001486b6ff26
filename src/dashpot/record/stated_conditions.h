#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "dashpot/physics/damper_description.h"
#include "dashpot/record.h"
#include "dashpot/record/dataset_file.h"
#include "dashpot/record/source_files.h"

namespace dashpot {

/// The conditions of records that stand in columns of the manifest, or follow from the drawing of
/// their damper. What is stated nearer goes first: by the recording itself, by the dataset file as
/// a number, in a column that it names, in a column by its name ("gap [mm]", "damper"), by a
/// drawing.
class StatedConditions {
 public:
  StatedConditions() = default;
  /// `folder`: of the dataset file, where its drawings lie.
  StatedConditions(const Manifest& manifest, std::filesystem::path folder);

  /// Adds them to a record of this file, whose drive level is known. Throws Error naming the
  /// manifest, the dataset file or the drawing.
  void add(Record& record, const SourcePath& file, const FileStatement& statement);
  /// What columns of the manifest were used for, or why one with a familiar name was not.
  const std::vector<std::string>& notes() const { return notes_; }
  /// Whether a column was used by its name, or notes() says why not.
  bool knows(const std::string& title) const { return known_.contains(title); }

 private:
  struct Column {
    std::string title, condition;
    double factor = 1, offset = 0;
  };
  void add_build_column();
  void add_column(Record& record, const SourcePath& file, const Column& column) const;
  void add_drawing(Record& record, const std::string& drawing, const std::filesystem::path& folder,
                   const std::string& where);

  const Manifest* manifest_ = nullptr;
  std::filesystem::path folder_;
  std::vector<Column> columns_;  ///< that are conditions by their names
  bool has_drawings_ = false;    ///< a column "damper" that names files
  std::map<std::string, DamperDescription> drawings_;
  std::vector<std::string> notes_;
  std::set<std::string> known_;  ///< titles
};

}  // namespace dashpot
