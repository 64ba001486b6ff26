#include <algorithm>
#include <cstring>
#include <map>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/base/merge_stores.h"
#include "dashpot/base/text.h"
#include "dashpot/identify/many/many.h"
#include "dashpot/identify/rank/fit_store.h"
#include "dashpot/identify/search/trial_store.h"
#include "dashpot/suspension/sweep/store.h"
#include "results.h"
#include "studies/family/training_store.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

struct MergeSettings {
  std::vector<std::string> stores;
  std::string folder;
};

constexpr std::string_view kMergeExample =
    "# A ranking in three parts, each on a machine of its own:\n"
    "dashpot rank recordings/ --simd avx2 --part 1/3 --output part1   # and 2/3, 3/3\n"
    "dashpot merge part1 part2 part3 --output ranking\n"
    "\n"
    "# The same command without --part finds all fits there, and judges:\n"
    "dashpot rank recordings/ --simd avx2 --output ranking";

/// The measures of a ride, one after the other.
std::string ride_difference(std::string_view a, std::string_view b) {
  if (a == b) return {};
  if (a.size() != b.size() || a.size() != sweep_measures().size() * sizeof(double))
    return "are not rides of one version";
  for (const SweepMeasure& measure : sweep_measures()) {
    double left = 0, right = 0;
    std::memcpy(&left, a.data(), sizeof left);
    std::memcpy(&right, b.data(), sizeof right);
    if (std::memcmp(&left, &right, sizeof left) != 0)
      return std::string(measure.name) + " is " + format_exact(left) + " and " +
             format_exact(right);
    a.remove_prefix(sizeof left);
    b.remove_prefix(sizeof left);
  }
  return {};
}

/// What can be joined.
struct MergedFormat {
  StoreFormat format;
  StoreDifference difference;
};

std::vector<MergedFormat> merged_formats() {
  return {{FitStore::kFormat, json_difference},
          {TrialStore::kFormat, json_difference},
          {TrainingStore::kFormat, json_difference},
          {kManyFormat, json_difference},
          {SweepStore::kFormat, ride_difference}};
}

/// The stores that a word names: itself, or those in the folder.
std::vector<fs::path> stores_named(const fs::path& word) {
  if (!fs::is_directory(word)) return {word};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(word))
    if (entry.path().extension() == ".sqlite") files.push_back(entry.path());
  if (files.empty())
    throw Error(word.string(), "holds no results", "a store is a file such as fits.sqlite");
  std::ranges::sort(files);
  return files;
}

/// Joins files of one name, which stand for one kind of work.
void merge_files(const std::vector<fs::path>& files, const fs::path& target, Console& console) {
  const StoreMark mark = store_mark(files.front());
  for (const auto& [format, difference] : merged_formats()) {
    if (format.name != mark.format) continue;
    const MergeReport report = merge_stores(files, target, format, difference);
    tell_dropped(report.dropped, target, console);
    console.print(fmt::format(
        "{}: {} from {}{}\n", target.string(), counted(report.results, "result"),
        counted(files.size(), "store"),
        report.repeated ? fmt::format("; {} found more than once, and alike", report.repeated)
                        : ""));
    return;
  }
  throw Error(files.front().string(), "holds " + mark.format + " results, which nothing joins");
}

int run_merge(const MergeSettings& settings, Console& console) {
  std::map<std::string, std::vector<fs::path>> files;  // by name
  for (const std::string& word : settings.stores)
    for (const fs::path& file : stores_named(word)) files[file.filename().string()].push_back(file);

  make_folder(settings.folder);
  for (const auto& [name, stores] : files) {
    console.check_stop();
    merge_files(stores, fs::path(settings.folder) / name, console);
  }
  return kDone;
}

}  // namespace

Command merge_command() {
  auto settings = std::make_shared<MergeSettings>();
  return {.name = "merge",
          .title = "Join the finished work of several machines",
          .description =
              "Joins the stores of --part into one in the folder of --output, of which the command "
              "that made them then finds its work done. Stores of other data or options are "
              "refused, and so are two that disagree on a task: with the task and both values. "
              "What is there stays; joining again changes nothing.",
          .options = {{.names = "STORE",
                       .target = &settings->stores,
                       .help = "a file such as fits.sqlite, or a folder of results",
                       .takes = Takes::File,
                       .required = true},
                      {.names = "-o,--output",
                       .target = &settings->folder,
                       .help = "the folder whose stores take all results",
                       .value = "DIR",
                       .takes = Takes::Folder,
                       .required = true}},
          .example = std::string(kMergeExample),
          .run = [settings](Console& console) { return run_merge(*settings, console); }};
}

}  // namespace dashpot::cli
