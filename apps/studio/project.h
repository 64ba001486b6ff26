#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "child.h"
#include "dashpot/value.h"

namespace dashpot::studio {

/// The folder that the studio and the command line share:
///   recordings/, or files that lie beside it     what was measured
///   dataset.yaml                                 what was corrected by hand
///   fits/NAME/                                   results of `dashpot rank`: models, report, kept
///                                                fits
///   rides/NAME/, designs/NAME/, exports/NAME/    results of `dashpot ride`, `design`, `export`
///   .studio/                                     what is drawn from, and can be made again
/// Everything is read by children of this program with limits of memory and time. One studio has a
/// project at a time. Safe from several threads.
class Project {
 public:
  /// Makes the folder's own parts. Throws Error when another studio has it.
  explicit Project(const std::filesystem::path& folder);
  ~Project();
  Project(const Project&) = delete;
  Project& operator=(const Project&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  /// The recordings as they are understood now: what `dashpot inspect --json` says, with what could
  /// not be read, or {"error": ...}. Made anew where a file of the folder has changed.
  Value recordings();
  /// The folder of samples of these recordings, for SampleView.
  std::filesystem::path samples() const { return folder_ / ".studio" / "samples"; }

  /// Corrects a file by hand: `dashpot inspect --correct`. {"command"} or {"error"}.
  Value correct(const std::string& file, const std::string& corrections);

  /// Where a new recording of this name is written: first here ...
  std::filesystem::path incoming() const;
  /// ... and then moved to its place. `name` is relative ("bench 3/run1.csv"). Throws Error on a
  /// name that leaves the folder, is hidden, or is taken by another content.
  void take_in(const std::filesystem::path& incoming, const std::string& name);

  /// Forces that a model gave on the recordings: the folder of samples that `dashpot evaluate
  /// --traces raw` wrote. `model`: "fits/NAME/models/x.json". Throws Error where it cannot be run.
  std::filesystem::path traces(const std::string& model);

  /// A model as the module of JavaScript that `dashpot export --to js` wrote. `model` as above.
  /// Throws Error where it cannot become one.
  std::filesystem::path module(const std::string& model);

  /// What `dashpot rank --costs` estimates of every model on these recordings: a list of {"model",
  /// "seconds"}, empty where there are none.
  Value costs();

  /// The model files of all results in "fits" or "designs", as paths from the folder.
  std::vector<std::string> models(std::string_view results = "fits") const;

  /// Makes the folder of a result, "fits" / "name", where no command looks for recordings.
  std::filesystem::path make_result(std::string_view results, const std::string& name) const;

  /// A text for people: paths in it without the folder before them.
  std::string without_folder(std::string text) const;

  /// A path below the folder; throws Error where it leaves it, or runs through a link.
  std::filesystem::path inside(const std::string& relative) const;

 private:
  std::string fingerprint() const;

  std::filesystem::path folder_;
  int lock_ = -1;
  std::mutex mutex_;  ///< of what follows, and of the children that read
  std::string known_fingerprint_;
  Value known_, known_costs_;
  std::string fingerprint_of_costs_;
};

/// A name of a fit or a part of a file's name: letters, digits and what people write between them;
/// not hidden, no way out.
bool is_plain_name(std::string_view name);
/// What such a name is, to be said where one is none.
inline constexpr const char* kPlainName =
    "at most 120 bytes without '/', '\\' and control characters, the first neither '.' nor '-'";

/// What a child said that went wrong: its last error without the label, or how it ended.
std::string error_of(const ChildEnd& end);

}  // namespace dashpot::studio
