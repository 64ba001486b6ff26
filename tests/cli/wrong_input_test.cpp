#include <cmath>
#include <filesystem>
#include <functional>
#include <unistd.h>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "program.h"

// What people get wrong, end to end: the program ends with its code and says where, what, and what would be
// right. Messages of single parts are tested beside those parts.

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

/// A sine on a damper with friction, one sample each 5 ms: t, x, F, i.
std::vector<std::string> sine_row(int k) {
  const double phase = 2 * 3.14159265358979 * k * 0.005;
  return {format_number(k * 0.005, 9), format_number(10 * std::sin(phase), 9),
          format_number(300 * std::tanh(5 * std::cos(phase)), 9), "1"};
}

constexpr const char* kNames = "t_s,x_mm,F_N,i_A\n";

/// The sine as CSV below `names`; `change` may alter the cells of a row.
using Change = std::function<void(int, std::vector<std::string>&)>;
std::string csv(const Change& change = {}, int rows = 300, const std::string& names = kNames) {
  std::string text = names;
  for (int k = 0; k < rows; ++k) {
    std::vector<std::string> row = sine_row(k);
    if (change) change(k, row);
    text += join(row, ",") + '\n';
  }
  return text;
}

/// One cell of row 100, which is line 102 of the file.
Change cell(std::size_t column, const std::string& text) {
  return [=](int k, std::vector<std::string>& row) {
    if (k == 100) row[column] = text;
  };
}

/// Every row scaled in one column.
Change scaled(std::size_t column, double factor) {
  return [=](int, std::vector<std::string>& row) {
    row[column] = format_number(factor * *parse_number(row[column]), 9);
  };
}

void drop_force(int, std::vector<std::string>& row) { row.erase(row.begin() + 2); }
void drop_current(int, std::vector<std::string>& row) { row.pop_back(); }

std::string dataset_file(const std::string& entry) {
  return "files:\n  - match: '*.csv'\n    " + entry + '\n';
}

/// Files, and what the program makes of them. In `arguments` DIR is the folder that holds them.
struct Wrong {
  std::string what;
  std::vector<std::pair<std::string, std::string>> files;
  std::string arguments;
  int exit_code;
  std::vector<std::string> said;
};

void check(const Wrong& wrong) {
  CAPTURE(wrong.what);
  const TemporaryFolder folder;
  for (const auto& [name, content] : wrong.files) folder.write(name, content);
  std::string arguments = wrong.arguments;
  for (std::size_t at; (at = arguments.find("DIR")) != std::string::npos;)
    arguments.replace(at, 3, folder.path().string());
  const ProgramResult result = run_dashpot(arguments);
  CAPTURE(result.output);
  CHECK(result.exit_code == wrong.exit_code);
  for (const std::string& part : wrong.said) CHECK_MESSAGE(contains(result.output, part), part);
}

std::string cut_mat() {
  // The head of a version 5 file, then an element that promises 4096 bytes and has 8.
  std::string text = "MATLAB 5.0 MAT-file";
  text.resize(124, ' ');
  return text + std::string("\x00\x01IM\x0e\x00\x00\x00\x00\x10\x00\x00\x06\x00\x00\x00\x08\x00\x00\x00", 20);
}

const std::string kRank = "rank DIR --models bingham --quiet --output DIR/results";
const std::string kFit = "identify DIR --models bingham --quiet --output DIR/results";

}  // namespace

TEST_CASE("recordings that cannot be used") {
  const Wrong table[] = {
      {"a missing column",
       {{"r.csv", csv(drop_force, 300, "t_s,x_mm,i_A\n")}},
       "inspect DIR/r.csv",
       1,
       {"r.csv: no column is force", "'t_s', 'x_mm', 'i_A'", "dataset file"}},
      {"text",
       {{"r.csv", csv(cell(2, "abc"))}},
       "inspect DIR",
       1,
       {"r.csv:102: force (F_N) is 'abc'", "12.5"}},
      {"NaN", {{"r.csv", csv(cell(2, "NaN"))}}, "inspect DIR", 1, {"r.csv:102: force (F_N) is 'NaN'"}},
      {"infinity", {{"r.csv", csv(cell(1, "1e999"))}}, "inspect DIR", 1, {"r.csv:102: displacement"}},
      {"an empty cell", {{"r.csv", csv(cell(2, ""))}}, "inspect DIR", 1, {"r.csv:102: force (F_N) is empty"}},
      {"time backwards",
       {{"r.csv", csv(cell(0, "0.3"))}},
       "inspect DIR",
       1,
       {"r.csv:102: time runs backwards: 0.3 after 0.495", "must increase"}},
      {"a gap in time",
       {{"r.csv", csv([](int k, auto& row) {
           if (k > 99) row[0] = format_number(k * 0.005 + 1, 9);
         })}},
       "inspect DIR",
       1,
       {"r.csv: velocity cannot be derived", "resample"}},
      {"two units",
       {{"r.csv", csv({}, 300, std::string(kNames) + "s,m,N,A\n")}},
       "inspect DIR",
       1,
       {"column 'x_mm' has two units: 'mm' in its name and 'm' below it"}},
      {"two columns of one name",
       {{"r.csv", csv({}, 300, "t_s,x_mm,x_mm,F_N\n")}},
       "inspect DIR",
       1,
       {"both displacement", "dataset file"}},
      {"0 bytes", {{"good_1A.csv", csv()}, {"r.csv", ""}}, "inspect DIR", 1, {"r.csv: is empty (0 bytes)"}},
      {"one sample", {{"r.csv", csv({}, 1)}}, "inspect DIR", 1, {"r.csv: has 1 sample;", "at least 2"}},
      {"three samples", {{"r.csv", csv({}, 3)}}, "inspect DIR", 1, {"r.csv: velocity", "only 3 samples"}},
      {"UTF-16",
       {{"r.csv", std::string("\xFF\xFEt\0,\0", 6)}},
       "inspect DIR",
       1,
       {"r.csv: is UTF-16", "UTF-8"}},
      {"a long line",
       {{"r.csv", std::string(kNames) + std::string(3 << 20, '1')}},
       "inspect DIR",
       1,
       {"r.csv:2: a line of more"}},
      {"a truncated MAT file", {{"r.mat", cut_mat()}}, "inspect DIR", 1, {"r.mat"}},
      {"garbage",
       {{"r.mat", std::string(500, '\xA7')}},
       "inspect DIR/r.mat",
       1,
       {"r.mat: is not a MAT file"}},
      {"force beyond all scales",
       {{"r.csv", csv(scaled(2, 1e300))}},
       "inspect DIR",
       1,
       {"r.csv: force (F_N) reaches", "unit"}},
      {"no files", {}, "inspect DIR", 1, {"the folder holds no files", ".csv"}},
      {"a cut-off too high",
       {{"r.csv", csv()}},
       "inspect DIR --velocity-cutoff 1e6",
       1,
       {"r.csv: low-pass", "100 Hz"}},
      {"no current",
       {{"a_1Hz.csv", csv(drop_current, 300, "t_s,x_mm,F_N\n")},
        {"b_2Hz.csv", csv(drop_current, 300, "t_s,x_mm,F_N\n")}},
       kFit,
       1,
       {"has no known current", "manifest.csv"}},
      {"constant force",
       {{"a_1Hz.csv", csv(scaled(2, 0))}, {"b_2Hz.csv", csv(scaled(2, 0))}},
       kFit,
       1,
       {"the force is constant"}},
      {"no motion",
       {{"a_1Hz.csv", csv(scaled(1, 0))}, {"b_2Hz.csv", csv(scaled(1, 0))}},
       kFit,
       1,
       {"nothing moves in any of them"}},
      {"one record",
       {{"a_1Hz.csv", csv()}},
       kFit + " --leave-out condition",
       1,
       {"cannot be divided", "fraction=0.3"}},
      {"a parameter that no model has",
       {{"a_1Hz.csv", csv()}, {"b_2Hz.csv", csv()}},
       kFit + " --fix c1=3",
       2,
       {"--fix: no model to be fitted has a parameter 'c1'; did you mean"}},
      {"a prior of the wrong unit",
       {{"a_1Hz.csv", csv()}, {"b_2Hz.csv", csv()}},
       kFit + " --prior c0=3mm+-1mm",
       2,
       {"--prior, c0: 'mm' is not a unit of it; it is counted in N*s/m"}},
      {"bounds beyond the law's",
       {{"a_1Hz.csv", csv()}, {"b_2Hz.csv", csv()}},
       kFit + " --bounds c0=-5:5",
       2,
       {"c0: its bounds -5 ... 5 N*s/m reach beyond the law's"}},
      {"rank: constant force",
       {{"a_1Hz.csv", csv(scaled(2, 0))}, {"b_2Hz.csv", csv(scaled(2, 0))}},
       kRank,
       1,
       {"the force is constant"}},
      {"rank: one record",
       {{"a_1Hz.csv", csv()}},
       kRank + " --leave-out condition",
       1,
       {"cannot be divided", "fraction=0.3"}},
      {"rank: no files", {}, "rank DIR", 1, {"the folder holds no files"}},
      {"rank: a folder that cannot be made",
       {{"a_1Hz.csv", csv()}, {"b_2Hz.csv", csv()}, {"results", "old"}},
       kRank,
       1,
       {"results/models: cannot make this folder"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("recordings that are doubtful are read, and the doubt is said") {
  const Wrong table[] = {
      {"kN called N", {{"r.csv", csv(scaled(2, 1e-3))}}, "inspect DIR", 0, {" N: is its unit N right?"}},
      {"other files",
       {{"r.csv", csv()}, {"photo.jpg", "\xFF\xD8"}, {"notes.txt", "hello\n"}},
       "inspect DIR",
       0,
       {"photo.jpg: passed over", "notes.txt: passed over"}},
      {"old line ends",
       {{"r.csv",
         [] {
           std::string text = csv();
           for (char& c : text)
             if (c == '\n') c = '\r';
           return text;
         }()}},
       "inspect DIR",
       0,
       {"300"}},
      {"names that are no UTF-8 and control a terminal",
       {{"r\xFF.csv", csv({}, 300, "t_s,x_mm,F_N,\x1b[2Jred\n")}},
       "inspect DIR",
       0,
       {"?[2Jred", "r\xEF\xBF\xBD"}},
      {"quotes and blanks in a name",
       {{"a 'b' \"c\"; $d.csv", csv()}},
       "inspect DIR",
       0,
       {"a 'b' \"c\"; $d"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("dataset files that cannot be used") {
  const auto with = [](const std::string& text) {
    return std::vector<std::pair<std::string, std::string>>{{"r_1A.csv", csv()}, {"dataset.yaml", text}};
  };
  const Wrong table[] = {
      {"an unknown key",
       with(dataset_file("chanels: {}")),
       "inspect DIR",
       1,
       {"dataset.yaml:3", "unknown key 'chanels'; did you mean 'channels'?"}},
      {"an unknown unit",
       with(dataset_file("channels: {force: {column: F_N, unit: Nm2}}")),
       "inspect DIR",
       1,
       {"dataset.yaml:3", "'Nm2'"}},
      {"a unit of another quantity",
       with(dataset_file("channels: {force: {column: F_N, unit: mm}}")),
       "inspect DIR",
       1,
       {"unit 'mm' does not fit force", "N"}},
      {"a column that is not there",
       with(dataset_file("channels: {force: {column: Load}}")),
       "inspect DIR",
       1,
       {"r_1A.csv: has no column 'Load'", "dataset.yaml:3"}},
      {"text for a number",
       with(dataset_file("channels: {force: {column: F_N, scale: much}}")),
       "inspect DIR",
       1,
       {"dataset.yaml:3: 'scale' is text, not a number"}},
      {"nothing", with(""), "inspect DIR", 1, {"dataset.yaml", "mapping"}},
      {"binary", with("\x80\x81\x82"), "inspect DIR", 1, {"dataset.yaml"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("model files that cannot be used") {
  const TemporaryFolder fitted;
  const std::string folder = fitted.path().string();
  REQUIRE(run_dashpot("identify " + small_campaign().string() +
                      " --quiet --models bingham --no-report --output " + folder)
              .exit_code == 0);
  const std::string good = read_file(fitted.path() / "models/bingham.json");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return std::vector<std::pair<std::string, std::string>>{{"m.json", text.replace(at, from.size(), to)}};
  };
  const std::string run = "evaluate DIR/m.json " + small_campaign().string();
  const Wrong table[] = {
      {"an unknown key",
       with("\"version\"", "\"colour\": 1, \"version\""),
       run,
       1,
       {"m.json", "unknown key 'colour'"}},
      {"another version",
       with("\"version\": 1", "\"version\": 2"),
       run,
       1,
       {"version 2 is not known here", "reads version 1"}},
      {"an unknown law",
       with("\"law\": \"bingham\"", "\"law\": \"bing\""),
       run,
       1,
       {"m.json", "'bing'", "bingham"}},
      {"a negative sample time",
       with("\"sample_time\": ", "\"sample_time\": -"),
       run,
       1,
       {"m.json, sample_time: is negative"}},
      {"cut off", {{"m.json", good.substr(0, good.size() / 2)}}, run, 1, {"m.json:", "not valid JSON"}},
      {"empty", {{"m.json", ""}}, run, 1, {"m.json:1: is not valid JSON"}},
      {"deep", {{"m.json", std::string(100000, '[')}}, run, 1, {"m.json: is nested more than"}},
      {"a folder", {}, "evaluate DIR DIR", 1, {"is a folder, not a file"}},
      {"an unknown model name",
       {},
       "identify DIR --models bingam",
       2,
       {"unknown model 'bingam'; did you mean 'bingham'?"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("links are followed once, a link to nothing and a pipe are named") {
  const TemporaryFolder folder, elsewhere;
  folder.write("a_1A.csv", csv());
  elsewhere.write("b_2A.csv", csv());
  const fs::path root = folder.path();
  fs::create_directory(root / "sub");
  fs::create_directory_symlink(root, root / "sub/up");
  fs::create_directory_symlink(elsewhere.path(), root / "linked");
  const ProgramResult loop = run_dashpot("inspect " + root.string());
  CHECK(loop.exit_code == 0);
  CHECK(contains(loop.output, "2 records from 2 files"));

  run_program("mkfifo " + (root / "pipe.csv").string());
  const ProgramResult pipe = run_dashpot("inspect " + root.string());
  CHECK(pipe.exit_code == 0);
  CHECK(contains(pipe.output, "pipe.csv: passed over: is not a regular file"));

  fs::create_symlink(root / "a_1A.csv", root / "again.csv");
  const ProgramResult twice = run_dashpot("inspect " + root.string());
  CHECK(twice.exit_code == 1);
  CHECK(contains(twice.output, "again.csv: is the same file as "));
  fs::remove(root / "again.csv");

  fs::create_symlink(root / "gone.csv", root / "dangling.csv");
  const ProgramResult dangling = run_dashpot("inspect " + root.string());
  CHECK(dangling.exit_code == 1);
  CHECK(contains(dangling.output, "dangling.csv: is a link to what is not there"));
}

TEST_CASE("several files and folders are one dataset, each file once") {
  const TemporaryFolder folder;
  const std::string a = folder.write("a_1A.csv", csv()).string(),
                    b = folder.write("more/b_2A.csv", csv()).string();
  const std::string more = (folder.path() / "more").string();
  CHECK(contains(run_dashpot("inspect " + a + " " + more).output, "2 records from 2 files"));
  const ProgramResult twice = run_dashpot("inspect " + a + " " + more + " " + b);
  CHECK(twice.exit_code == 1);
  CHECK(contains(twice.output, "is the same file as"));
}

TEST_CASE("a results folder that cannot be written is refused before the fit") {
  const TemporaryFolder folder;
  const std::string file = folder.write("results", "old").string();
  const ProgramResult result =
      run_dashpot("identify " + small_campaign().string() + " --models bingham --output " + file);
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "results/models: cannot make this folder"));
  CHECK(!contains(result.output, "fitting"));
  CHECK(read_file(file) == "old");
}

TEST_CASE("file names that are no UTF-8 cost nobody the results") {
  const TemporaryFolder folder;
  for (const char* name : {"a\xFF_1Hz.csv", "b\xFF_2Hz.csv"}) folder.write(name, csv());
  const std::string results = (folder.path() / "out").string();
  const ProgramResult result =
      run_dashpot("identify " + folder.path().string() + " --models bingham --quiet --output " + results);
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK(contains(read_file(results + "/models/bingham.json"), "a\xEF\xBF\xBD_1Hz"));
}

TEST_CASE("closed and full streams, a reader that leaves") {
  const TemporaryFolder folder;
  const std::string results = (folder.path() / "out").string();
  const std::string fit = program_path() + " identify " + small_campaign().string() +
                          " --quiet --models bingham --output " + results;
  CHECK(run_program("( " + fit + " <&- >&- 2>&- )").exit_code == 1);
  CHECK(read_file(results + "/report.json").starts_with("{"));  // the table did not go into the report

  const ProgramResult full =
      run_program("( " + program_path() + " inspect " + small_campaign().string() + " >/dev/full )");
  CHECK(full.exit_code == 1);
  CHECK(contains(full.output, "standard output: cannot be written"));

  fs::remove_all(results);
  const ProgramResult left = run_program("bash -c '" + fit + " 2>&1 | true; exit ${PIPESTATUS[0]}'");
  CHECK(left.exit_code == 128 + 13);  // SIGPIPE, as other programs do
  CHECK(left.output == "");
  CHECK(fs::exists(results + "/report.html"));
}

TEST_CASE("no HOME, a German locale, a terminal of 20 columns") {
  const TemporaryFolder folder;
  const std::string rest =
      program_path() + " identify " + small_campaign().string() + " --quiet --models bingham --output ";
  const auto report = [&](const std::string& environment, const std::string& name) {
    const ProgramResult result =
        run_program("env " + environment + " " + rest + (folder.path() / name).string());
    CHECK_MESSAGE(result.exit_code == 0, result.output);
    return read_file(folder.path() / name / "report.csv");
  };
  const std::string plain = report("COLUMNS=100", "plain");
  CHECK(report("-u HOME LANG=de_DE.UTF-8 LC_ALL=de_DE.UTF-8", "locale") == plain);
  CHECK(report("COLUMNS=20", "narrow") == plain);
}
