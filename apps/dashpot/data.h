#pragma once
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/dataset.h"

namespace dashpot::cli {

/// How a command gets its recordings.
struct DataSettings {
  std::vector<std::string> paths;
  LoadOptions load;
  bool verbose = false;
};

/// The rows that every command with DATA has.
std::vector<Option> data_options(DataSettings& settings);

/// Reads the recordings and prints, on stderr, what was understood: briefly, or all of it when
/// verbose.
Dataset load_recordings(const DataSettings& settings, Console& console);

/// What was inferred, assumed or passed over, as notes.
void print_notes(const Dataset& dataset, Console& console, std::size_t most);

/// "utfsm: 20 records, 4 conditions, 5 currents 0 ... 1 A, 812 s".
std::string summary(const Dataset& dataset);

}  // namespace dashpot::cli
