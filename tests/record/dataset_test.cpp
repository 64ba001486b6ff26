#include "dashpot/dataset.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "dashpot/base/file.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/record/dataset_file.h"
#include "dashpot/record/mat_bytes.h"
#include "dashpot/split.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A sine of 10 mm and 1 Hz, 100 Hz for 3 s, with force = 1000 N*s/m * v; `sign` turns the force
/// round.
std::string sine_csv(double sign = 1) {
  std::string text = "t_s,x_mm,F_N\n";
  for (int k = 0; k < 300; ++k) {
    const double t = k / 100.0, w = 2 * M_PI;
    char line[96];
    std::snprintf(line, sizeof line, "%.2f,%.6f,%.6f\n", t, 10 * std::sin(w * t),
                  sign * 10 * w * std::cos(w * t));
    text += line;
  }
  return text;
}

Dataset load(const std::filesystem::path& path) { return load_dataset({path}); }

std::string message_for(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  const auto path = folder.write(name, text);
  return message_of([&] { load(path); });
}

/// The same sine as a MAT file, which a single number `name` stands beside.
std::string sine_mat(const std::vector<std::pair<std::string, double>>& numbers) {
  MatVariable x{.name = "x_mm", .rows = 300, .columns = 1}, force{.name = "F_N", .rows = 1};
  for (int k = 0; k < 300; ++k) {
    x.values.push_back(10 * std::sin(0.02 * M_PI * k));
    force.values.push_back(20 * M_PI * std::cos(0.02 * M_PI * k));
  }
  force.columns = force.values.size();
  std::vector<MatVariable> all{x, force};
  for (const auto& [name, value] : numbers)
    all.push_back({.name = name, .rows = 1, .columns = 1, .values = {value}});
  return mat_bytes(all);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("where no column is the drive, those that are not used are named") {
  const TemporaryFolder folder;
  std::string text = "t_s,x_mm,F_N,I set [A],duty [%]\n";
  for (int k = 0; k < 100; ++k)
    text += std::to_string(0.01 * k) + ',' + std::to_string(10 * std::sin(0.2 * k)) + ',' +
            std::to_string(300 * std::cos(0.2 * k)) + ",0.5,50\n";
  const Dataset data = load_dataset({folder.write("run.csv", text)});
  CHECK(data.drive_unit == DriveUnit::None);
  CHECK(std::ranges::any_of(data.notes, [](const std::string& note) {
    return contains(note, "if it is a column that is not used ('I set [A]', 'duty [%]'), state");
  }));
}

TEST_CASE("a current sensor whose zero is off by less than nothing reads 0 A, and no -0 A") {
  const TemporaryFolder folder;
  std::string text = "t_s,x_mm,F_N,I_A\n";
  for (int k = 0; k < 200; ++k)
    text += format_number(0.01 * k, 6) + "," + format_number(10 * std::sin(0.0628 * k), 6) + "," +
            format_number(500 * std::cos(0.0628 * k), 6) + ",-0.0004\n";
  folder.write("run.csv", text);
  const Dataset dataset = load(folder.path());
  CHECK(!std::signbit(*dataset.records.at(0).drive_level));
}

TEST_CASE("a folder of CSV files is understood by its names") {
  const TemporaryFolder folder;
  folder.write("run_0A.csv", sine_csv());
  folder.write("run_0.5A.csv", sine_csv());
  folder.write("notes.txt", "nothing but words\n");
  const Dataset dataset = load(folder.path());
  REQUIRE(dataset.records.size() == 2);
  CHECK(dataset.drive_unit == DriveUnit::Ampere);
  CHECK(*dataset.records[0].drive_level == 0);
  CHECK(*dataset.records[1].drive_level == 0.5);
  CHECK(dataset.records[0].condition == "10 mm 1 Hz");
  CHECK(dataset.records[1].condition == dataset.records[0].condition);
  CHECK(dataset.records[0].sample_time == 0.01);
  CHECK(has(describe(dataset), "notes.txt: passed over: it holds no table of numbers"));
  const Channel& velocity = dataset.records[0].channel("velocity");
  CHECK(has(velocity.origin, "Hz zero-phase"));
  // The middle of the record, away from the filter's ends: v = 2 pi 10 mm/s cos.
  CHECK_CLOSE(velocity.samples[100], 0.0628318, 0.01, 0);
  CHECK(dataset.records[1].channel("current").samples[7] == 0.5);
}

TEST_CASE("a force that is recorded the other way round is turned and said so") {
  const TemporaryFolder folder;
  const Dataset dataset = load(folder.write("run_1A.csv", sine_csv(-1)));
  CHECK_CLOSE(dataset.records[0].channel("force").samples[0], 62.83, 1e-3, 0);
  CHECK(has(describe(dataset), "force sign flipped"));
}

TEST_CASE("a number behind a current's symbol in a name is told where it has no unit") {
  const TemporaryFolder folder;
  CHECK(has(describe(load(folder.write("run_I=0.5_f=1Hz.csv", sine_csv(1)))),
            "'I=0.5' in the name of run_I=0.5_f=1Hz is taken as one only with its unit"));
}

TEST_CASE("a folder keeps its whole name, points and all") {
  const TemporaryFolder folder;
  folder.write("run2.5mm/run_1A.csv", sine_csv(1));
  CHECK(load(folder.path() / "run2.5mm").name == "run2.5mm");
}

TEST_CASE("wrong input is refused with its place") {
  const std::string good = "t_s,x_mm,F_N\n0,1,2\n0.1,2,3\n";
  CHECK(has(message_for("a.csv", "t_s,x_mm\n0,1\n0.1,2\n"),
            "no column is force by its name (it has 't_s', 'x_mm')"));
  // A ride, which another command takes, and a bench's recording, which lacks its force.
  const std::string in_plant = "'dashpot identify --in PLANT' finds the damper there; else state";
  CHECK(has(message_for("a.csv", "t_s,road [m],az [m/s^2]\n0,0,1\n0.1,0,2\n"), in_plant));
  CHECK(has(message_for("a.csv", "t_s,az,level\ns,g,mm\n0,0,1\n0.1,0,2\n"), in_plant));
  CHECK_FALSE(has(message_for("a.csv", "t_s,x_mm\n0,1\n1,2\n"), in_plant));
  CHECK(has(message_for("a.csv", "t_s,x_mm,Peak force [N]\n0,1,2\n0.1,2,3\n"),
            "'Peak force [N]' not used: 'Peak force' is not a measurement by its name"));
  CHECK(has(message_for("a.csv", good + "0.2,abc,3\n0.3,2,3\n"),
            "a.csv:4: displacement (x_mm) is 'abc', not a finite number"));
  CHECK(has(message_for("a.csv", "t;x [mm];F [N]\n0;1,5;2,5\n0,1;2,5;7.415\n"),
            "a.csv:3: force (F [N]) is '7.415', and the file's decimal sign is ',': in thousands"));
  CHECK(has(message_for("a.csv", good + "0.2,2,nan\n0.3,2,3\n"), "a.csv:4: force (F_N) is 'nan'"));
  CHECK(has(message_for("a.csv", good + "0.2,2,inf\n0.3,2,3\n"), "a.csv:4: force (F_N) is 'inf'"));
  CHECK(has(message_for("a.csv", good + "0.2,2,\n0.3,2,3\n"), "a.csv:4: force (F_N) is empty"));
  CHECK(has(message_for("a.csv", good + "0.05,2,3\n"), "a.csv:4: time runs backwards"));
  CHECK(has(message_for("a.csv", good + "0.1,2,3\n"), "a.csv:4: time 0.1 is repeated"));
  CHECK(has(message_for("a.csv", "t,x [mm],F\ns,m,N\n0,1,2\n1,2,3\n"),
            "two units: 'mm' in its name and 'm' below it"));
  CHECK(has(message_for("a.csv", "t,x_mm,displacement_mm,F\n0,1,1,2\n1,2,3,3\n"),
            "are both displacement"));
  CHECK(has(message_for("a.csv", "t,x_mm,F_N,F_N\n0,1,1,2\n1,2,3,3\n"),
            "'channels: {force: {column: 3}}'"));
  CHECK(has(message_for("a.csv", "t,x,F\n0,1,2\n"), "has 1 sample"));
  CHECK(has(message_for("a.csv", "0,1,2\n1,2,3\n"), "state them by number in a dataset file"));
  CHECK(has(message_for("a.csv", ""), "is empty (0 bytes)"));
  CHECK(has(message_for("a.csv", "x_mm,F_N\n0,1\n1,2\n"), "no column is time by its name"));
  CHECK(has(message_for("a.csv", "t,x,F\n0,1,2\n0.1,2,3\n0.35,3,3\n0.4,2,1\n0.5,1,1\n"),
            "time stamps are not uniform"));
  CHECK(has(message_of([] { load("/nowhere/at/all"); }), "there is no such file or folder"));
  const TemporaryFolder folder;
  CHECK(has(message_of([&] { load(folder.path()); }), "Dashpot looks for MAT (.mat)"));
}

TEST_CASE("a dataset file states what cannot be inferred") {
  const TemporaryFolder folder;
  std::string text;
  for (int k = 0; k < 400; ++k)
    text += std::to_string(k % 7) + ";" + std::to_string(100 + k) + ";" +
            std::to_string(k < 200 ? 1 : 2) + "\n";
  folder.write("a.txt", text);
  folder.write("dataset.yaml", R"(name: stated
drive: V
leave_out: fraction=0.25
files:
  - match: "*.txt"
    time: {sample_rate: 100}
    channels:
      displacement: {column: 2, unit: cm, scale: 2, offset: 100, sign: -1}
      force: {column: 1, unit: kN, sign: 1}
      voltage: 3
    cut: {from: 0.5, to: 2.5}
    velocity_cutoff: 12
    conditions: {temperature: 25 degC}
    condition: ramp
)");
  const Dataset dataset = load(folder.path());
  REQUIRE(dataset.records.size() == 1);
  const Record& record = dataset.records[0];
  CHECK(record.size() == 201);
  CHECK(record.condition == "ramp");
  CHECK(record.time[0] == 0.5);
  CHECK_CLOSE(record.channel("displacement").samples[0], -1.0, 1e-12, 0);  // -(2 * 50) cm
  CHECK(record.channel("force").samples[0] == 1000.0 * (50 % 7));
  CHECK(has(record.channel("velocity").origin, "12 Hz zero-phase (stated)"));
  CHECK_CLOSE(record.conditions.at(0).second, 298.15, 1e-12, 0);
  CHECK(!record.drive_level);
  CHECK(dataset.drive_unit == DriveUnit::Volt);
  CHECK(format_leave_out(*dataset.leave_out) == "fraction=0.25");
}

TEST_CASE("a stated column may be named without the unit in brackets behind it, which counts") {
  const auto loaded = [](const std::string& header, const std::string& more = "") {
    const TemporaryFolder folder;
    std::string text = header + "\n";
    for (int k = 0; k < 40; ++k)
      text += std::to_string(k) + "," + std::to_string(k % 7) + "," + std::to_string(k % 5) + more +
              "\n";
    folder.write("a.csv", text);
    folder.write("dataset.yaml",
                 "files:\n  - match: a.csv\n    time: {column: T}\n    channels:\n"
                 "      displacement: {column: Way}\n      force: {column: Cell (upper)}\n");
    return load(folder.path()).records.front();
  };
  const Record record = loaded("T [ms],Way (mm),Cell (upper) [kN]");
  CHECK_CLOSE(record.time[1], 1e-3, 1e-12, 0);
  const std::vector<double>& way = record.channel("displacement").samples;  // about its mean
  CHECK_CLOSE(way[1] - way[0], 1e-3, 1e-9, 0);
  CHECK_CLOSE(record.channel("force").samples[1], 1000, 1e-12, 0);

  // One that two columns have is none.
  CHECK(has(message_of([&] { loaded("T [ms],Way (mm),Cell (upper) [kN],Way [in]", ",1"); }),
            "has no column 'Way' for displacement"));
}

TEST_CASE("rows that a logger lost: the message says how many, and what it proposes works") {
  const TemporaryFolder folder;
  std::string text = "t_s,x_mm,F_N\n";
  for (int k = 0; k < 300; ++k)
    if (k != 100 && k != 101 && k != 200)
      text += format_number(0.01 * k, 6) + "," + format_number(10 * std::sin(0.0628 * k), 6) + "," +
              format_number(500 * std::cos(0.0628 * k), 6) + "\n";
  const auto path = folder.write("run_1A.csv", text);
  CHECK(has(message_of([&] { load(path); }),
            "not uniform, 3 samples are missing in 2 places by the time stamps, the first behind "
            "0.99 s; state in a dataset file 'resample: 100'"));
  folder.write("dataset.yaml", "files:\n  - match: run_1A.csv\n    resample: 100\n");
  CHECK(load(folder.path()).records.at(0).size() == 300);
}

TEST_CASE("a stated rate that is not the stamps' is told") {
  const TemporaryFolder folder;
  folder.write("run_1A.csv", sine_csv());
  const auto described = [&](const std::string& rate) {
    folder.write("dataset.yaml",
                 "files:\n  - match: run_1A.csv\n    time: {sample_rate: " + rate + "}\n");
    return describe(load(folder.path()));
  };
  CHECK(has(described("1000"),
            "samples are taken as 0.001 s apart, not as 0.01 s, which the column 't_s' says"));
  CHECK_FALSE(has(described("100"), "samples are taken as"));
}

TEST_CASE("a rate beside a time column that says otherwise is told; the column counts") {
  const TemporaryFolder folder;
  const auto described = [&](double rate) {
    std::vector<MatVariable> all{
        {.name = "t_s", .rows = 1}, {.name = "x_mm", .rows = 1}, {.name = "F_N", .rows = 1}};
    for (int k = 0; k < 200; ++k) {
      all[0].values.push_back(0.01 * k);
      all[1].values.push_back(10 * std::sin(0.0628 * k));
      all[2].values.push_back(500 * std::cos(0.0628 * k));
    }
    for (MatVariable& variable : all) variable.columns = variable.values.size();
    all.push_back({.name = "fs", .rows = 1, .columns = 1, .values = {rate}});
    const Dataset dataset = load(folder.write("run_1A.mat", mat_bytes(all)));
    CHECK(dataset.records.at(0).sample_time == 0.01);
    return describe(dataset);
  };
  CHECK(has(described(1000),
            "samples are taken as 0.01 s apart, as the column 't_s' says; the "
            "number 'fs' means 0.001 s"));
  CHECK_FALSE(has(described(100), "samples are taken as"));
}

TEST_CASE("mistakes in a dataset file are refused at their line") {
  const auto message = [](const std::string& line) {
    const TemporaryFolder folder;
    folder.write("a.csv", sine_csv());
    folder.write("dataset.yaml", "files:\n  - match: a.csv\n    " + line + "\n");
    return message_of([&] { load(folder.path()); });
  };
  CHECK(message("level: 1").empty());
  CHECK(has(message("cutt: {}"), "dataset.yaml"));
  CHECK(has(message("cutt: {}"), "cutt"));
  CHECK(has(message("channels: {force: {column: F, unit: N}}"), "has no column 'F' for force"));
  CHECK(has(message("channels: {force: {column: F, unit: N}}"), "it has 't_s', 'x_mm', 'F_N'"));
  CHECK(has(message("channels: {force: {column: F_N, unit: mm}}"), "dataset.yaml:3"));
  CHECK(has(message("channels: {force: {column: F_N, sign: 2}}"), "'sign' is neither 1 nor -1"));
  CHECK(has(message("time: {sample_rate: -1}"), "must be positive"));
  CHECK(has(message("level: nan"), "the drive level is not a finite number"));
  CHECK(has(message("condition: '{amp}'"), "'{amp}' in '{amp}' is unknown"));
  CHECK(has(message("cut: {from: 7}"), "leaves nothing"));
}

TEST_CASE("a current in a file of its own is named as one") {
  const TemporaryFolder folder;
  folder.write("run.csv", sine_csv());
  folder.write("run_current.csv", "t [s],Current (A)\n0,0.5\n0.01,0.5\n0.02,0.5\n");
  const Dataset dataset = load(folder.path());
  REQUIRE(dataset.records.size() == 1);
  REQUIRE(dataset.passed_over.size() == 1);
  CHECK(dataset.passed_over[0].why.find("it holds a current ('Current (A)') with neither motion") ==
        0);
}

TEST_CASE("roles give parts of one record that both run from its start") {
  const TemporaryFolder folder;
  folder.write("a.csv", sine_csv());
  folder.write("dataset.yaml",
               "leave_out: roles\nfiles:\n  - match: a.csv\n    level: 1\n    roles:\n"
               "      - {role: training, to: 2, score_from: 0.5}\n      - {role: left_out, "
               "score_from: 2}\n");
  const Dataset dataset = load(folder.path());
  REQUIRE(dataset.records.size() == 2);
  CHECK(dataset.records[0].size() == 200);
  CHECK(dataset.records[0].warm_up == 50);
  CHECK(dataset.records[1].size() == 300);
  CHECK(dataset.records[1].warm_up == 200);
  CHECK(split(dataset, *dataset.leave_out).size() == 1);
}

// The README and the manifests of the folders describe their recordings.
TEST_CASE("utfsm without any dataset file") {
  const auto folder = shared_data("utfsm");
  if (folder.empty()) return;
  LoadOptions by_names;
  by_names.recognise = false;
  const Dataset dataset = load_dataset({folder}, by_names);
  CHECK(dataset.records.size() == 20);
  std::set<std::string> conditions;
  std::set<double> levels;
  for (const Record& record : dataset.records)
    conditions.insert(record.condition), levels.insert(record.drive_level.value_or(-1));
  CHECK(conditions.size() == 4);
  CHECK(levels == std::set<double>{0, 0.25, 0.5, 0.75, 1});
  for (const char* file :
       {"ME25mm0x25Hz.txt.gz", "ME5mm3Hz.txt.gz", "published_bouc_wen_parameters.mat"})
    CHECK(std::any_of(dataset.passed_over.begin(), dataset.passed_over.end(),
                      [&](const PassedOver& passed) { return passed.file == file; }));
}

TEST_CASE("the shipped dataset files recognise the measured recordings" *
          doctest::test_suite("long")) {
  struct Shipped {
    const char *folder, *name, *drive;
    std::size_t records, folds;
  };
  for (const Shipped shipped :
       {Shipped{"utfsm", "utfsm", "A", 20, 4}, Shipped{"utfpr", "utfpr", "V", 38, 2},
        Shipped{"nees-2012-1158", "nees-2012-1158", "V", 1, 1},
        Shipped{"sysidentpy-simulated", "sysidentpy-simulated", "V", 2, 1},
        Shipped{"family-dnn", "family-dnn", "A", 108, 9},
        Shipped{"utfsm/ME5mm3Hz.txt.gz", "utfsm-daq-logs", "A", 5, 3}}) {
    CAPTURE(std::string(shipped.folder));
    const auto path = shared_data(shipped.folder);
    if (path.empty()) return;
    const Dataset dataset = load(path);
    CHECK(dataset.name == shipped.name);
    CHECK(to_string(dataset.drive_unit) == shipped.drive);
    CHECK(dataset.records.size() == shipped.records);
    REQUIRE(dataset.leave_out);
    CHECK(split(dataset, *dataset.leave_out).size() == shipped.folds);
    for (const Record& record : dataset.records) {
      CHECK(record.sample_time > 0);
      CHECK(record.find("velocity"));
      CHECK(record.find(dataset.drive_unit == DriveUnit::Ampere ? "current" : "voltage"));
    }
  }
}

TEST_CASE("utfsm force ranges are those of its manifest, from the DAQ logs too") {
  const auto folder = shared_data("utfsm");
  if (folder.empty()) return;
  const auto range = [](const Record& record) {
    const auto& f = record.channel("force").samples;
    return std::pair(*std::min_element(f.begin(), f.end()), *std::max_element(f.begin(), f.end()));
  };
  const auto check = [&](const Dataset& dataset, const std::string& name) {
    const auto at = std::find_if(dataset.records.begin(), dataset.records.end(),
                                 [&](const Record& r) { return r.name == name; });
    REQUIRE(at != dataset.records.end());
    CHECK_CLOSE(range(*at).first, -1492, 0, 1);  // manifest.csv: sine_5mm_3Hz_1A
    CHECK_CLOSE(range(*at).second, 1609, 0, 1);
  };
  check(load(folder), "sine_5mm_3Hz_1A");
  check(load(folder / "ME5mm3Hz.txt.gz"), "5 mm 3 Hz, 1 A");
}

TEST_CASE("nees ends at 21.15 s on the stated grid, and 14 s of it train") {
  const auto folder = shared_data("nees-2012-1158");
  if (folder.empty()) return;
  const Dataset dataset = load(folder);
  const Record& record = dataset.records.front();
  CHECK(record.sample_time == 1 / 3004.8);
  CHECK_CLOSE(record.time.back(), 21.15, 0, 1 / 3004.8);
  CHECK_CLOSE(split(dataset, *dataset.leave_out)[0].training[0].time.back(), 14.0, 0, 2e-3);
  CHECK_CLOSE(record.channel("displacement").samples[0], 0.00021147, 1e-9, 0);
}

TEST_CASE("family records carry geometry and yield stress in SI") {
  const auto folder = shared_data("family-dnn");
  if (folder.empty()) return;
  const Dataset dataset = load(folder);
  const Record& record = dataset.records[1];  // 03L_1.0R, field level 1; inp_twofluidexp.json
  CHECK(*record.drive_level == 0.25);
  CHECK(record.conditions[0] == std::pair<std::string, double>{"yield_stress", 20122.8539});
  CHECK(record.conditions.back() == std::pair<std::string, double>{"pole_length", 0.006});
}

TEST_CASE("any file may hold any bytes") {
  const TemporaryFolder folder;
  for (const char* name : {"a.csv", "a.mat", "a.txt", "a.json", "inp_a.json", "a.csv.gz"}) {
    for (const char* text : {"\x1f\x8b\x08garbage", "MATLAB 5.0", "MATLAB 7.3", "Header Size:  7",
                             "{}", "{\"a\":[{}]}", "\0\0\0\0"}) {
      folder.write("inp_a.json", "{}");
      const auto path = folder.write(name, text);
      CHECK(!message_of([&] { load_dataset({path}); }).empty());
    }
  }
}

namespace {

/// A sine of 10 mm about `middle` mm, with force = `gas` N + 1000 N*s/m * v, turned by `direction`.
std::string stroke_csv(double middle, double gas = 0, double direction = 1) {
  std::string text = "t_s,x_mm,F_N\n";
  for (int k = 0; k < 300; ++k) {
    const double t = k / 100.0, w = 2 * M_PI;
    char line[96];
    std::snprintf(line, sizeof line, "%.2f,%.6f,%.6f\n", t,
                  middle + direction * 10 * std::sin(w * t),
                  direction * (gas + 10 * w * std::cos(w * t)));
    text += line;
  }
  return text;
}

double mean_of(const Channel& channel) {
  double sum = 0;
  for (const double value : channel.samples) sum += value;
  return sum / static_cast<double>(channel.samples.size());
}

}  // namespace

TEST_CASE("an absolute stroke is centred, and it is said by how much") {
  const TemporaryFolder folder;
  folder.write("a_1A.csv", stroke_csv(75));
  folder.write("b_1A.csv", stroke_csv(-40));
  folder.write("c_1A.csv", stroke_csv(3));  // beside the middle, but about it
  const Dataset dataset = load(folder.path());
  const auto centre = [&](const char* name) {
    for (const Record& record : dataset.records)
      if (record.name == name) return mean_of(record.channel("displacement"));
    return kNaN;
  };
  CHECK_CLOSE(centre("a_1A"), 0, 0, 1e-12);
  CHECK_CLOSE(centre("b_1A"), 0, 0, 1e-12);
  CHECK_CLOSE(centre("c_1A"), 0.003, 0, 1e-9);
  const std::string text = describe(dataset);
  CHECK(has(text, "absolute stroke centred in 2 of 3 records, by -40 ... 75 mm"));
  CHECK(has(text, "displacement of 65 ... 85 mm is an absolute stroke"));

  // A record alone is centred as it is among others.
  CHECK_CLOSE(mean_of(load(folder.path() / "a_1A.csv").records[0].channel("displacement")), 0, 0,
              1e-12);
}

TEST_CASE("a stroke that is placed by its dataset file stays there") {
  const auto centre = [](const std::string& words) {
    const TemporaryFolder folder;
    folder.write("a_1A.csv", stroke_csv(75));
    folder.write("dataset.yaml",
                 "files:\n  - match: a_1A.csv\n    channels: {force: F_N, displacement: {column: "
                 "x_mm, unit: mm" +
                     words + "}}\n    level: 1\n");
    return mean_of(load(folder.path()).records.at(0).channel("displacement"));
  };
  CHECK_CLOSE(centre(""), 0, 0, 1e-12);
  CHECK_CLOSE(centre(", centre: mean"), 0, 0, 1e-12);
  CHECK_CLOSE(centre(", centre: none"), 0.075, 1e-9, 0);
  CHECK_CLOSE(centre(", offset: 70"), 0.005, 1e-6, 0);
}

TEST_CASE("the direction that counts as extension is said where nobody has stated it") {
  const auto notes = [](double gas, const std::string& dataset_file = "") {
    const TemporaryFolder folder;
    folder.write("a_1A.csv", stroke_csv(0, gas));
    if (!dataset_file.empty()) folder.write("dataset.yaml", dataset_file);
    return describe(load(folder.path()));
  };
  const std::string taken = "extension is taken as the direction in which 'x_mm' grows";
  CHECK(has(notes(0), taken + "; were it compression"));
  CHECK(!has(notes(0), "the force at rest"));
  CHECK(has(notes(-20), "the force at rest resists compression by 20 N, which speaks for"));
  CHECK(has(notes(20), "the force at rest resists extension by 20 N, which speaks against"));
  CHECK(has(notes(0), "state 'sign: -1' for displacement and 'sign: -1' for force"));

  // What the note proposes turns the record round, and silences it.
  const std::string stated =
      "files:\n  - match: a_1A.csv\n    level: 1\n    channels:\n"
      "      displacement: {column: x_mm, unit: mm, sign: -1}\n"
      "      force: {column: F_N, sign: -1}\n";
  CHECK(!has(notes(20, stated), "extension is taken"));
  const TemporaryFolder folder;
  folder.write("a_1A.csv", stroke_csv(0, 20));
  folder.write("dataset.yaml", stated);
  const Dataset turned = load(folder.path());
  CHECK_CLOSE(mean_of(turned.records.at(0).channel("force")), -20, 0.01, 0);
}

TEST_CASE("motions that run opposite ways and forces that drive are told") {
  std::string text = "t_s,x_mm,v_mm_s,F_N\n";
  for (int k = 0; k < 300; ++k) {
    const double t = k / 100.0, w = 2 * M_PI;
    text += std::to_string(t) + "," + std::to_string(10 * std::sin(w * t)) + "," +
            std::to_string(-10 * w * std::cos(w * t)) + "," +
            std::to_string(-10 * w * std::cos(w * t)) + "\n";
  }
  const TemporaryFolder folder;
  folder.write("a_1A.csv", text);
  CHECK(has(describe(load(folder.path())), "displacement falls where velocity is positive"));

  const TemporaryFolder stated;
  stated.write("a_1A.csv", stroke_csv(0));
  stated.write("dataset.yaml",
               "files:\n  - match: a_1A.csv\n    level: 1\n    channels:\n"
               "      displacement: {column: x_mm, unit: mm}\n"
               "      force: {column: F_N, sign: -1}\n");
  CHECK(has(describe(load(stated.path())), "the damper puts energy in"));
}

TEST_CASE("inertia between load cell and damper is taken off where it is stated, and told") {
  // 2 mm at 20 Hz (31.6 m/s^2) of 500 N*s/m behind 3 kg, at 2 kHz.
  std::string text = "t_s,x_mm,F_N\n";
  const double w = 2 * M_PI * 20;
  for (int k = 0; k < 2000; ++k) {
    const double t = k / 2000.0, v = 2e-3 * w * std::cos(w * t),
                 a = -2e-3 * w * w * std::sin(w * t);
    text += format_exact(t) + "," + format_exact(2 * std::sin(w * t)) + "," +
            format_exact(500 * v + 3 * a) + "\n";
  }
  const auto read = [&](const std::string& force) {
    const TemporaryFolder folder;
    folder.write("run_1A.csv", text);
    folder.write(
        "dataset.yaml",
        "files:\n  - match: run*.csv\n    channels:\n      displacement: x_mm\n      force: "
        "{column: F_N, unit: N" +
            force + "}\n    time: {sample_rate: 2000}\n    level: 1\n");
    return load(folder.path());
  };

  // Without a word the force stays, and what a kilogram would add is told.
  CHECK(
      has(describe(read("")), "each kilogram that moves between load cell and damper adds up to"));

  const Dataset damper = read(", moving_mass: 3");
  CHECK(has(describe(damper), "inertia of 3 kg between load cell and damper taken off"));
  const Record& record = damper.records.front();
  for (std::size_t k = 500; k < 1500; ++k) {
    const double v = 2e-3 * w * std::cos(w * record.time[k]);
    CHECK(std::abs(record.channel("force").samples[k] - 500 * v) < 2);  // of 126 N; 95 N before
  }
  CHECK(has(message_of([&] { read(", moving_mass: -1"); }), "0 or more"));
  CHECK(has(message_of([&] { read(", moving_mass: .inf"); }), "moving_mass"));
}

TEST_CASE("a noisy velocity beside the displacement has its noise taken off, or keeps it") {
  Random random(1);
  constexpr double w = 2 * std::numbers::pi;
  std::string text = "x_mm,v_m/s,F_N\n";
  for (int k = 0; k < 4000; ++k) {
    const double t = k / 1000.0, v = 0.02 * w * std::cos(w * t);
    text += format_exact(20 * std::sin(w * t)) + "," + format_exact(v + 5e-3 * random.normal()) +
            "," + format_exact(800 * v) + "\n";
  }
  const auto read = [&](const std::string& velocity) {
    const TemporaryFolder folder;
    folder.write("run_1A.csv", text);
    folder.write(
        "dataset.yaml",
        "files:\n  - match: run*.csv\n    channels:\n      displacement: x_mm\n      force: "
        "F_N\n      velocity: {column: v_m/s" +
            velocity + "}\n    time: {sample_rate: 1000}\n    level: 1\n");
    return load(folder.path());
  };
  const auto noise = [](const Dataset& data) {
    const Record& record = data.records.front();
    double square = 0;
    for (std::size_t k = 0; k < record.size(); ++k)
      square += std::pow(
          record.channel("velocity").samples[k] - 0.02 * w * std::cos(w * record.time[k]), 2);
    return std::sqrt(square / static_cast<double>(record.size()));
  };
  const Dataset joint = read(""), kept = read(", noise: keep");
  CHECK(noise(joint) < 1e-3);
  CHECK_CLOSE(noise(kept), 5e-3, 0.1, 0);
  CHECK(has(joint.records.front().channel("velocity").origin, " mm/s brought to "));
  CHECK(has(describe(joint), "the displacement takes noise off it"));
  CHECK_FALSE(has(describe(kept), "takes noise off"));
  CHECK(has(message_of([&] { read(", noise: take"); }), "it can be 'keep', of velocity"));
}

TEST_CASE("slow motions say nothing of inertia; a mass belongs to the force") {
  const TemporaryFolder folder;
  folder.write("run_0A.csv", sine_csv());
  CHECK_FALSE(has(describe(load(folder.path())), "each kilogram"));
  folder.write("dataset.yaml",
               "files:\n  - match: run*.csv\n    channels:\n      displacement: {column: x_mm, "
               "moving_mass: 1}\n      force: F_N\n");
  CHECK(has(message_of([&] { load(folder.path()); }), "it belongs to force"));
}

namespace {

/// Tests of 3 s one below the other in one table, each with its amplitude in mm and its current in
/// A, the damper's stroke about `middle` mm. Between them time goes on by `pause` s; the damper
/// rests for as long where the rest `is_recorded`.
std::string tests_csv(const std::vector<std::pair<double, double>>& tests, double middle,
                      double pause, bool is_recorded) {
  std::string text = "t_s,x_mm,F_N,I_A\n";
  double start = 0;
  const auto add = [&](double t, double x, double force, double current) {
    char line[96];
    std::snprintf(line, sizeof line, "%.2f,%.6f,%.6f,%.5f\n", t, middle + x, force, current);
    text += line;
  };
  for (const auto& [amplitude, current] : tests) {
    const double w = 2 * M_PI;
    for (int k = 0; k < 300; ++k, start += 0.01)
      add(start, amplitude * std::sin(w * k / 100), amplitude * w * std::cos(w * k / 100), current);
    for (double t = 0; is_recorded && t < pause - 1e-9; t += 0.01) add(start + t, 0, 0, current);
    start += pause;
  }
  return text;
}

}  // namespace

TEST_CASE("stretches of one recording share the centre of its stroke and the force's sign") {
  // The first stretch lies 5 mm below the second.
  const TemporaryFolder folder;
  std::string text = "t_s,x_mm,F_N\n";
  const double w = 2 * M_PI;
  for (int k = 0; k < 600; ++k) {
    char line[96];
    const double t = k / 100.0 + (k < 300 ? 0 : 2);
    std::snprintf(line, sizeof line, "%.2f,%.6f,%.6f\n", t,
                  75 + (k < 300 ? -2.5 : 2.5) + 10 * std::sin(w * t),
                  -10 * w * std::cos(w * t) * (k < 300 ? 1 : 0.001) + (k < 300 ? 0 : 0.1));
    text += line;
  }
  folder.write("a_1A.csv", text);
  const Dataset dataset = load(folder.path());
  REQUIRE(dataset.records.size() == 2);
  CHECK_CLOSE(mean_of(dataset.records[0].channel("displacement")), -2.5e-3, 1e-9, 0);
  CHECK_CLOSE(mean_of(dataset.records[1].channel("displacement")), 2.5e-3, 1e-9, 0);
  for (const Record& record : dataset.records)
    CHECK(has(record.channel("force").origin, "sign flipped"));
}

TEST_CASE("tests one below the other with gaps in time: levels may be listed, one per stretch") {
  const TemporaryFolder folder;
  folder.write("run.csv", tests_csv({{10, 0}, {10, 0.5}, {10, 1}}, 0, 3, false));
  CHECK(load(folder.path()).records.at(2).drive_level == 1);

  const auto levels = [&](const std::string& words) {
    folder.write("dataset.yaml",
                 "files:\n  - match: run.csv\n    channels: {displacement: {column: x_mm, unit: "
                 "mm}, force: F_N}\n    level: " +
                     words + "\n");
    std::vector<double> found;
    for (const Record& record : load(folder.path()).records) found.push_back(*record.drive_level);
    return found;
  };
  CHECK(levels("[0, 0.7, 1.4]") == std::vector<double>{0, 0.7, 1.4});
  CHECK(levels("[2]") == std::vector<double>{2, 2, 2});
  CHECK(has(message_of([&] { levels("[0, 0.7]"); }),
            "'level' lists 2 levels, and gaps in the time of run.csv leave 3 stretches"));
}

TEST_CASE("tests with recorded rests between them are told, and roles make records of them") {
  const TemporaryFolder folder;
  folder.write("run.csv", tests_csv({{10, 0}, {5, 0.5}, {20, 1}}, 0, 2, true));
  const Dataset whole = load(folder.path());
  REQUIRE(whole.records.size() == 1);
  CHECK(has(describe(whole), "the damper rests for up to 2 s between 3 motions"));
  CHECK_FALSE(whole.records[0].drive_level);

  folder.write("dataset.yaml",
               "files:\n  - match: run.csv\n    channels: {displacement: {column: x_mm, unit: mm}, "
               "force: F_N, current: I_A}\n    roles:\n"
               "      - {role: training, from: 0, to: 3}\n"
               "      - {role: training, from: 5, to: 8}\n"
               "      - {role: left_out, from: 10, to: 13}\n");
  const Dataset parts = load(folder.path());
  REQUIRE(parts.records.size() == 3);
  for (const double level : {0.0, 0.5, 1.0})
    CHECK(std::ranges::count(parts.records, level, &Record::drive_level) == 1);

  // Neither a single test nor a slow one that dwells where it turns is several.
  folder.write("dataset.yaml", "files:\n  - match: run.csv\n");
  folder.write("run.csv", tests_csv({{10, 1}}, 0, 2, true));
  CHECK_FALSE(has(describe(load(folder.path())), "motions, taken as one record"));
  std::string slow = "t_s,x_mm,F_N\n";
  for (int k = 0; k < 3000; ++k)
    slow += format_number(0.1 * k, 6) + "," + format_number(10 * std::sin(0.06 * k), 6) + "," +
            format_number(50 * std::cos(0.06 * k), 6) + "\n";
  folder.write("run.csv", slow);
  CHECK_FALSE(has(describe(load(folder.path())), "motions, taken as one record"));
}

TEST_CASE("levels of a recorded current go with the largest of all records") {
  // A damper of 25 mA, with a sensor's noise of +-0.05 mA.
  const TemporaryFolder folder;
  for (const double level : {0.0, 2.5, 5.0, 25.0}) {
    std::string text = "t_s,x_mm,F_N,I_mA\n";
    for (int k = 0; k < 200; ++k)
      text += format_number(0.01 * k, 6) + "," + format_number(10 * std::sin(0.0628 * k), 6) + "," +
              format_number(500 * std::cos(0.0628 * k), 6) + "," +
              format_number(level + (k % 2 ? 0.05 : -0.05), 6) + "\n";
    folder.write("run" + format_number(10 * level) + ".csv", text);
  }
  const Dataset dataset = load(folder.path());
  REQUIRE(dataset.records.size() == 4);
  for (const double level : {0.0, 0.0025, 0.005, 0.025})
    CHECK(std::ranges::count(dataset.records, level, &Record::drive_level) == 1);
  CHECK(split(dataset, parse_leave_out("current=0.005"))[0].left_out.size() == 1);

  // A slow swing of 10 mA is no noise of such a sensor.
  std::string text = "t_s,x_mm,F_N,I_mA\n";
  for (int k = 0; k < 200; ++k)
    text += format_number(0.01 * k, 6) + "," + format_number(10 * std::sin(0.0628 * k), 6) + "," +
            format_number(500 * std::cos(0.0628 * k), 6) + "," +
            format_number(10 + 5 * std::sin(0.05 * k), 6) + "\n";
  folder.write("varied.csv", text);
  const Dataset varied = load(folder.path());
  CHECK(std::ranges::count_if(varied.records, [](const Record& r) { return !r.drive_level; }) == 1);
}

TEST_CASE("levels of a drive of 20 mA: constant ones, ones that vary, and the noise of a zero") {
  using Drive = double (*)(int);
  const auto levels_of = [](const std::vector<Drive>& drives) {
    const TemporaryFolder folder;
    for (std::size_t run = 0; run < drives.size(); ++run) {
      std::string text = "t_s,x_mm,F_N,I_mA\n";
      for (int k = 0; k < 200; ++k)
        text += format_number(0.01 * k, 6) + "," + format_number(10 * std::sin(0.0628 * k), 6) +
                "," + format_number(500 * std::cos(0.0628 * k), 6) + "," +
                format_number(drives[run](k), 6) + "\n";
      folder.write("run" + std::to_string(run) + ".csv", text);
    }
    std::vector<std::optional<double>> levels;
    for (const Record& record : load(folder.path()).records) levels.push_back(record.drive_level);
    return levels;
  };
  using Levels = std::vector<std::optional<double>>;

  // Constant, with a noise of 0.1 mA.
  CHECK(levels_of({[](int k) { return 0.1 * (k % 2); }, [](int k) { return 10 + 0.1 * (k % 2); },
                   [](int k) { return 20 + 0.1 * (k % 2); }}) == Levels{0, 0.01, 0.02});

  // Switched between 0 and 20 mA, and a slow swing, both of which no record at rest goes beside.
  CHECK(levels_of({[](int k) { return k / 25 % 2 ? 20. : 0.; },
                   [](int k) { return 10 + 8 * std::sin(0.05 * k); }}) ==
        Levels{std::nullopt, std::nullopt});

  // A zero that hums or flickers by as much.
  CHECK(levels_of({[](int k) { return 10 * std::sin(0.3 * k); }}) == Levels{0});
  CHECK(levels_of({[](int k) { return 5. + 5 * (k * 7 % 5 - 2); }}) == Levels{0.01});
}

TEST_CASE("two columns that could be time: what the message proposes works") {
  const TemporaryFolder folder;
  std::string text = "time [s],t_ms,x_mm,F_N\n";
  for (int k = 0; k < 200; ++k)
    text += format_number(0.01 * k, 6) + "," + format_number(10 * k + 7, 6) + "," +
            format_number(10 * std::sin(0.0628 * k), 6) + "," +
            format_number(500 * std::cos(0.0628 * k), 6) + "\n";
  const auto path = folder.write("run_1A.csv", text);
  CHECK(has(message_of([&] { load(path); }),
            "are both time by their names; state which in a dataset file, as in "
            "'time: {column: \"time [s]\"}'"));
  folder.write("dataset.yaml", "files:\n  - match: run_1A.csv\n    time: {column: \"time [s]\"}\n");
  CHECK(load(folder.path()).records.at(0).sample_time == 0.01);
}

TEST_CASE("a current that is a single number of a MAT file is the level of its record") {
  const TemporaryFolder folder;
  const auto record_of = [&](const std::string& name, double value, const char* file = "run.mat") {
    return load(folder.write(file, sine_mat({{"fs", 100}, {name, value}}))).records.at(0);
  };
  CHECK(*record_of("current_A", 0.5).drive_level == 0.5);
  CHECK(*record_of("Strom_mA", 750).drive_level == 0.75);
  CHECK(record_of("voltage_V", 2).find("voltage"));

  // It goes before a name, and says so.
  const Record other = record_of("current_A", 0.5, "run_1A.mat");
  CHECK(*other.drive_level == 0.5);
  CHECK(std::ranges::any_of(other.notes, [](const std::string& note) {
    return has(note, "the single number 'current_A' counts, 0.5 A, not the file name");
  }));

  // One letter may be any number of a workspace, and two numbers leave a doubt.
  CHECK(*record_of("I", 7).drive_level == 0);
  const auto two = folder.write("two.mat", sine_mat({{"fs", 100}, {"i_A", 1}, {"current_A", 2}}));
  CHECK(has(message_of([&] { load(two); }),
            "the single number 'i_A' and the single number 'current_A' may be it"));
}
