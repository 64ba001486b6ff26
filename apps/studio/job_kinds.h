#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/value.h"
#include "project.h"

namespace dashpot::studio {

/// A kind of long work that a command does in the background, each piece in a folder of its own.
struct JobKind {
  std::string_view name;    ///< "fit", as people call one
  std::string_view folder;  ///< of the project, that holds those folders: "fits"
  std::string_view result;  ///< the file that a run leaves there when it comes to its end
  /// The command line without the program and --output. Throws Error where `asked` is no such
  /// work, or names what the project does not have. `folder`: of the piece, not made yet.
  std::vector<std::string> (*words)(const Project& project, const std::filesystem::path& folder,
                                    const Value& asked);
  /// What is asked for where it goes on in its folder; null: the same as before.
  Value (*continued)(const std::filesystem::path& folder, const Value& asked);
  /// Writes what the command reads from the folder; null: nothing.
  void (*prepare)(const Project& project, const std::filesystem::path& folder, const Value& asked);
};

/// "fit": {"models": ["bingham", ...], "leave_out": ""}, as `dashpot rank` takes them; of one law
/// also {"from": ...}, where its search begins (start_model.h).
/// "ride": a drive (vehicle_words.h) with {"controllers": ["skyhook", ...], "bound": false}.
/// "design": {"request": YAML, "points", "generations", "seed", "goes_on": false}, the last of
/// these from the designs in its folder. Throws Error on any other name.
const JobKind& job_kind(std::string_view name);
std::span<const JobKind> job_kinds();

}  // namespace dashpot::studio
