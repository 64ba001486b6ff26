#include <cmath>
#include <cstdio>
#include <filesystem>
#include <matio.h>

#include "damper/inverse/example_network.h"
#include "dashpot/base/data_folder.h"
#include "dashpot/base/file.h"
#include "dashpot/damper/inverse/inverse_file.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/model_file.h"
#include "export/example_models.h"
#include "fuzz.h"
#include "record/readers/example_hdf5.h"
#include "record/readers/example_lvm.h"
#include "record/readers/example_mdf4.h"
#include "record/readers/example_tdms.h"
#include "record/readers/example_workbook.h"

namespace fs = std::filesystem;
using dashpot::write_file;

namespace {

constexpr int kRows = 16;

double x(int k) { return 10 * std::sin(0.7 * k); }
double force(int k) { return 100 * std::cos(0.7 * k); }

/// One line per sample: row number or time, x, F.
std::string rows(const std::string& separator, double step, const std::string& end) {
  std::string text;
  for (int k = 0; k < kRows; ++k)
    text += std::to_string(step * k) + separator + std::to_string(x(k)) + separator +
            std::to_string(force(k)) + end;
  return text;
}

void csv_seeds(const fs::path& folder) {
  write_file(folder / "plain", "t_s,x_mm,F_N\n" + rows(",", 0.01, "\n"));
  write_file(folder / "tabs",
             "junk: 1\n\nTime\tStroke\tForce\n(s)\t(mm)\t(kN)\n" + rows("\t", 0.01, "\r\n"));
  write_file(folder / "quoted", "# c\n\"t [s]\";\"x [mm]\";\"F [N]\"\n" + rows(";", 0.01, ";\n"));
  write_file(folder / "comma",
             "t;displacement(mm);F_N\n0,0;1,5;2\n0,1;2,5;3\n0,2;1,5;2\n0,3;0,5;1\n0,4;1,5;2\n");
  write_file(folder / "blanks", rows("  ", 0.01, "\n"));
}

void mat_seed(const fs::path& path, mat_ft version, matio_compression compression) {
  fs::create_directories(path.parent_path());
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
  if (!file) return;
  std::vector<double> columns[3];
  for (int k = 0; k < kRows; ++k) {
    columns[0].push_back(0.01 * k);
    columns[1].push_back(x(k));
    columns[2].push_back(force(k));
  }
  const char* names[] = {"t", "x_mm", "F_N"};
  std::size_t dims[] = {kRows, 1};
  for (int c = 0; c < 3; ++c) {
    matvar_t* variable =
        Mat_VarCreate(names[c], MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, columns[c].data(), 0);
    Mat_VarWrite(file, variable, compression);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
}

std::string daq_seed() {
  std::string text =
      " 4\nSampling Interval: 0.01\nSample Count: 16\nSample Number, CHANNEL0, CHANNEL1, Events\n";
  for (int k = 0; k < kRows; ++k)
    text += std::to_string(k) + ", " + std::to_string(x(k)) + ", " + std::to_string(force(k)) +
            (k == 8   ? ", DAQ Resume\n"
             : k == 7 ? ", DAQ Pause\n"
                      : ",\n");
  return text;
}

std::string model_seed(std::unique_ptr<dashpot::DamperModel> model, dashpot::DriveUnit drive_unit) {
  dashpot::ModelFile file;
  file.model = std::move(model);
  file.drive_unit = drive_unit;
  return dashpot::format_model(file);
}

/// One law, and the example of every other kind.
void model_seeds(const fs::path& folder) {
  using namespace dashpot;
  const LawModel law = load_parameters("spencer1997");
  write_file(folder / "law", model_seed(law.with_offset(0), law.drive_unit()));
  for (const ExampleModel& example : example_models())
    if (example.model->kind() != ModelKind::Law || example.name.starts_with("law_of_file"))
      write_file(folder / example.name,
                 model_seed(example.model->with_offset(0), DriveUnit::Ampere));
}

constexpr const char* kFamily =
    R"({"d1":[{"time":[0,0.1,0.2,0.3,0.4],"velocity":[1,2,1,0,1],"displace":[0,1,2,1,0],"force":[1,2,3,2,1]}]}
#
{"d1":{"Ty":[1000],"viscocidad":0.1,"Ap":0.01,"Ag":0.001,"h":0.001,"L":0.01}}
)";
constexpr const char* kDataset = R"(name: seed
drive: A
leave_out: fraction=0.3
files:
  - match: ["*.csv", run*]
    time: {column: t_s, unit: s}
    channels:
      displacement: {column: x_mm, unit: mm, centre: mean}
      force: {column: 3, unit: N, scale: 2, offset: 1, sign: -1}
    cut: {from: 0.05, to: 0.35}
    resample: 200
    velocity_cutoff: 20
    name: "{stem}, {level} A"
    level: 0.5
    roles: [{role: training, to: 0.2}, {role: left_out, from: 0.2, score_from: 0.25}]
notes: a note
)";

std::string xlsx_rows_seed() {
  std::string rows;
  for (int k = 0; k < 6; ++k)
    rows += row_of({number_cell(std::to_string(0.01 * k)), number_cell(std::to_string(k % 3)),
                    number_cell(std::to_string(7 * k), k % 4)});
  return rows + "<row r=\"9\"><c r=\"A9\" t=\"e\"><v>#N/A</v></c></row>";
}

/// Files that come with Dashpot.
void data_seeds(const fs::path& folder) {
  struct Kind {
    const char *target, *data, *ending;
  };
  for (const Kind& kind : {Kind{"design_yaml", "designs", ".yaml"},
                           {"dataset_yaml", "datasets", ".yaml"},
                           {"damper_yaml", "dampers", ".yaml"},
                           {"sweep_yaml", "sweeps", ".yaml"},
                           {"parameter_set_json", "parameters", ".json"},
                           {"plant_set_json", "plants", ".json"},
                           {"curve_file", "curves", ".csv"}})
    for (const std::string& name : dashpot::data_names(kind.data, kind.ending))
      write_file(folder / kind.target / name,
                 dashpot::read_file(dashpot::data_folder(kind.data) / (name + kind.ending)));
}

}  // namespace

void write_seeds(const fs::path& folder) {
  write_file(folder / "law_yaml" / "two_states", kExampleLawText);
  write_file(folder / "law_yaml" / "travels", kTravellingLawText);
  csv_seeds(folder / "csv");
  mat_seed(folder / "mat/4", MAT_FT_MAT4, MAT_COMPRESSION_NONE);
  mat_seed(folder / "mat/5", MAT_FT_MAT5, MAT_COMPRESSION_NONE);
  mat_seed(folder / "mat/5z", MAT_FT_MAT5, MAT_COMPRESSION_ZLIB);
  mat_seed(folder / "mat/73", MAT_FT_MAT73, MAT_COMPRESSION_NONE);
  for (const int way : {0, 1, 2, 3})
    write_file(folder / "mdf4" / std::to_string(way), example_mdf4(way));
  fs::create_directories(folder / "hdf5");
  write_example_hdf5(folder / "hdf5/groups", {"a", "b"});
  write_example_hdf5(folder / "hdf5/one", {"a"});
  write_file(folder / "tdms/chunks", example_tdms(false, false));
  write_file(folder / "tdms/rows", example_tdms(true, true));
  write_file(folder / "tdms/daqmx", example_tdms_daqmx());
  write_file(folder / "xlsx/run", example_recording_workbook());
  write_file(folder / "xlsx_sheet/rows", xlsx_rows_seed());
  for (const char* x_columns : {"One", "Multi", "No"})
    write_file(folder / "lvm" / x_columns, example_lvm(x_columns));
  write_file(folder / "daq_text/log", daq_seed());
  write_file(folder / "family_json/pair", kFamily);
  write_file(folder / "dataset_yaml/all", kDataset);
  model_seeds(folder / "model_json");
  for (const dashpot::InverseNetworkPreset& preset : dashpot::inverse_network_presets())
    write_file(folder / "inverse_json" / preset.name,
               dashpot::format_inverse({.network = example_network(preset),
                                        .domain = {.current_max = 1},
                                        .provenance = {},
                                        .quality = {}}));
  data_seeds(folder);

  // Targets that read the same in another way.
  constexpr std::pair<const char*, const char*> kCopies[] = {{"csv", "csv_table"},
                                                             {"hdf5", "hdf5_tables"},
                                                             {"mat", "mat_tables"},
                                                             {"mdf4", "mdf4_tables"},
                                                             {"tdms", "tdms_tables"},
                                                             {"xlsx", "xlsx_tables"},
                                                             {"dataset_yaml", "dataset_file"}};
  for (const auto& [from, to] : kCopies)
    fs::copy(folder / from, folder / to,
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  write_word_seeds(folder);
  write_store_seeds(folder);
}
