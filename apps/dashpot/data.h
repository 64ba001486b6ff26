#pragma once
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/dataset.h"

namespace dashpot::cli {

/// The recordings that a command reads, and the options of reading them.
struct DataSettings {
  std::vector<std::string> paths;
  LoadOptions load;
  bool verbose = false;
};

/// The rows that every command with DATA has.
std::vector<Option> data_options(DataSettings& settings);

/// The files of the paths: a folder stands for those in it. Throws Error where there is none.
std::vector<std::string> recording_files(const std::vector<std::string>& paths);

/// Reads the recordings and prints, on stderr, what was understood: briefly, or all of it when
/// verbose.
Dataset load_recordings(const DataSettings& settings, Console& console);

/// Notes on the data: inferences, assumptions, files passed over.
void print_notes(const Dataset& dataset, Console& console, std::size_t most);

}  // namespace dashpot::cli
