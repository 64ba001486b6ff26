#include "data.h"

#include <set>

#include <fmt/core.h>

#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/report/words.h"

namespace dashpot::cli {
namespace {

constexpr std::size_t kNotesInBrief = 6;

std::string drive_levels(const Dataset& dataset) {
  std::set<double> levels;
  for (const Record& record : dataset.records)
    if (record.drive_level) levels.insert(*record.drive_level);
  if (levels.empty()) return "the drive varies within the records";
  const std::string noun = drive_channel(dataset.drive_unit);
  if (levels.size() == 1)
    return fmt::format("1 {}, {} {}", noun, format_number(*levels.begin()),
                       to_string(dataset.drive_unit));
  return fmt::format("{} {} ... {} {}", counted(levels.size(), noun),
                     format_number(*levels.begin()), format_number(*levels.rbegin()),
                     to_string(dataset.drive_unit));
}

}  // namespace

std::vector<Option> data_options(DataSettings& settings) {
  return {{.names = "DATA",
           .target = &settings.paths,
           .help = "recordings: files or folders (CSV, DAQ text, MAT, JSON; also .gz), or a "
                   "dataset file (.yaml)",
           .takes = Takes::File,
           .required = true},
          {.names = "--dataset",
           .target = &settings.load.dataset_file,
           .help = "a dataset file that states channels, units and conditions",
           .value = "FILE",
           .takes = Takes::File,
           .default_text = "dataset.yaml beside the data, if there"},
          {.names = "--no-recognise",
           .target = &settings.load.recognise,
           .help = "do not look for these recordings among the known published ones"},
          {.names = "--velocity-cutoff",
           .target = &settings.load.velocity_cutoff_hz,
           .help = "cut-off of the zero-phase filter that velocity is derived with",
           .value = "HZ",
           .minimum = 0,
           .default_text = "from the motion, and stated"},
          {.names = "-v,--verbose",
           .target = &settings.verbose,
           .help = "print all that was understood of the data"}};
}

std::string summary(const Dataset& dataset) {
  std::set<std::string> conditions;
  double seconds = 0;
  for (const Record& record : dataset.records) {
    conditions.insert(record.condition);
    if (!record.time.empty()) seconds += record.time.back() - record.time.front();
  }
  return fmt::format(
      "{}: {}, {}, {}, {} s", dataset.name, counted(dataset.records.size(), "record"),
      counted(conditions.size(), "condition"), drive_levels(dataset), format_number(seconds, 3));
}

void print_notes(const Dataset& dataset, Console& console, std::size_t most) {
  for (std::size_t i = 0; i < std::min(most, dataset.notes.size()); ++i)
    console.note(dataset.notes[i]);
  if (dataset.notes.size() > most)
    console.note(fmt::format("and {} more; --verbose prints them", dataset.notes.size() - most));
  if (dataset.passed_over.empty()) return;
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> files;
  for (const PassedOver& passed : dataset.passed_over) files.push_back(passed.file);
  const std::size_t more = files.size() - std::min(files.size(), kNamed);
  files.resize(files.size() - more);
  console.note(fmt::format("passed over: {}{}; --verbose says why", join(files, ", "),
                           more > 0 ? fmt::format(" and {} more", more) : ""));
}

Dataset load_recordings(const DataSettings& settings, Console& console) {
  LoadOptions options = settings.load;
  options.monitor = console.monitor();
  Dataset dataset = load_dataset({settings.paths.begin(), settings.paths.end()}, options);
  if (settings.verbose) {
    console.talk(describe(dataset));
  } else {
    console.talk(summary(dataset) + '\n');
    print_notes(dataset, console, kNotesInBrief);
  }
  console.check_stop();
  return dataset;
}

}  // namespace dashpot::cli
