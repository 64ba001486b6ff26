#include "data.h"

#include <fmt/core.h>

#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/source_files.h"
#include "dashpot/report/provenance.h"

namespace dashpot::cli {
namespace {

constexpr std::size_t kNotesInBrief = 6;

}  // namespace

std::vector<Option> data_options(DataSettings& settings) {
  return {{.names = "DATA",
           .target = &settings.paths,
           .help = "recordings: files or folders (CSV, XLSX, MDF 4, TDMS, HDF5, "
                   "MAT, text logs, JSON), or a dataset file (.yaml)",
           .takes = Takes::File,
           .required = true},

          // Statements that override what is read from the files themselves.
          {.names = "--dataset",
           .target = &settings.load.dataset_file,
           .help = "a dataset file that states channels, units and conditions",
           .value = "FILE",
           .takes = Takes::File,
           .default_text = "dataset.yaml beside the data, if there"},
          {.names = "--no-recognise",
           .target = &settings.load.recognise,
           .help = "do not look for these recordings among the known published ones"},

          // The processing of the recordings, and the report on it.
          {.names = "--velocity-cutoff",
           .target = &settings.load.velocity_cutoff_hz,
           .help = "cut-off frequency of the zero-phase filter that velocity is derived with",
           .value = "HZ",
           .minimum = 0,
           .default_text = "from the motion, and stated"},
          {.names = "-v,--verbose",
           .target = &settings.verbose,
           .help = "print everything that was understood of the data"}};
}

std::vector<std::string> recording_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const SourcePath& file : list_files({paths.begin(), paths.end()}))
    files.push_back(file.path.string());
  if (files.empty()) throw Error(join(paths, ", "), "holds no file", "a folder of recordings");
  return files;
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
  console.files_unread = !dataset.unread.empty();
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
