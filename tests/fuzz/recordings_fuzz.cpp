#include "dashpot/dataset.h"
#include "dashpot/record/dataset_file.h"
#include "fuzz.h"
#include "record/readers/example_workbook.h"

// Everything that recordings are read from.

namespace {

/// What every dataset keeps: one sample per stamp, finite, in increasing time.
void require_sound(const dashpot::Dataset& dataset) {
  for (const dashpot::Record& record : dataset.records) {
    require_true(record.size() >= 2 && record.find("force") && record.find("velocity"));
    for (std::size_t k = 1; k < record.size(); ++k)
      require_true(record.time[k] > record.time[k - 1]);
    for (const dashpot::Channel& channel : record.channels) {
      require_true(channel.samples.size() == record.size());
      for (const double value : channel.samples) require_true(std::isfinite(value));
    }
  }
}

/// Loads a file as the command line would, by its name.
void load_fuzzed(const std::filesystem::path& path, const std::string& dataset_file = {}) {
  dashpot::LoadOptions options;
  options.recognise = false;
  options.dataset_file = dataset_file;
  const dashpot::Dataset dataset = dashpot::load_dataset({path}, options);
  require_sound(dataset);
  dashpot::describe(dataset);
}

void daq_text(const std::string& input) {
  const std::string columns =
      "name: fuzz\nfiles:\n  - match: '*'\n    level: 1\n    channels:\n"
      "      displacement: {column: 2, unit: mm}\n      force: {column: 3, unit: kN, centre: "
      "mean}\n";
  load_fuzzed(fuzz_file("run.txt", "Header Size: " + input),
              fuzz_file("daq.yaml", columns).string());
}

void dataset_yaml(const std::string& input) {
  static const std::filesystem::path data = [] {
    std::string text = "t_s,x_mm,F_N,i_A\n";
    for (int k = 0; k < 40; ++k)
      text += std::to_string(0.01 * k) + "," + std::to_string(k % 10) + "," +
              std::to_string(k % 7) + ",1\n";
    return fuzz_file("run_0.5A.csv", text);
  }();
  load_fuzzed(data, fuzz_file("dataset.yaml", input).string());
}

/// The dataset file alone, without the recordings that it is about.
void dataset_file(const std::string& input) {
  const dashpot::DatasetFile stated = dashpot::load_dataset_file(fuzz_file("alone.yaml", input));
  for (const dashpot::FileStatement& file : stated.files) require_true(!file.match.empty());
}

/// The rows of a sheet as XML, which mutated zip files hardly ever show.
void xlsx_sheet(const std::string& input) {
  const std::string names = row_of({text_cell("t [s]"), text_cell("x [mm]"), text_cell("F [N]")});
  load_fuzzed(fuzz_file("run_0.5A.xlsx", example_workbook({{"run", names + input, ""}})));
}

/// The recordings, a line of one '#', the dampers.
void family_json(const std::string& input) {
  const std::size_t at = input.find("\n#\n");
  fuzz_file("inp_data.json", at == std::string::npos ? "{}" : input.substr(at + 3));
  load_fuzzed(fuzz_file("data.json", input.substr(0, at)));
}

const FuzzTarget targets[] = {
    {"csv",
     [](const std::string& input) { load_fuzzed(fuzz_file("run_10mm_1Hz_0.5A.csv", input)); }},
    {"mat", [](const std::string& input) { load_fuzzed(fuzz_file("run_0.5A.mat", input)); }},
    {"mdf4", [](const std::string& input) { load_fuzzed(fuzz_file("run_0.5A.mf4", input)); }},
    {"hdf5", [](const std::string& input) { load_fuzzed(fuzz_file("run_0.5A.h5", input)); }},
    {"tdms", [](const std::string& input) { load_fuzzed(fuzz_file("run_0.5A.tdms", input)); }},
    {"xlsx", [](const std::string& input) { load_fuzzed(fuzz_file("run_0.5A.xlsx", input)); }},
    {"lvm", [](const std::string& input) { load_fuzzed(fuzz_file("run_0.5A.lvm", input)); }},
    {"xlsx_sheet", xlsx_sheet},
    {"daq_text", daq_text},
    {"dataset_file", dataset_file},
    {"dataset_yaml", dataset_yaml},
    {"family_json", family_json}};

}  // namespace
