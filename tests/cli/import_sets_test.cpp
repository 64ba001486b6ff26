#include "wrong_input.h"

// The recording sets of people who tried Dashpot for the first time: what each is, and what must
// happen. Nothing may be read wrongly in silence: a set is read right, or asked about.

using namespace dashpot;

namespace {

constexpr const char* kPlain = "t_s,x_mm,F_N\n";

/// The sine without its current, below other names.
std::string passive(const std::string& names = kPlain, int rows = 300) {
  return csv(drop_current, rows, names);
}

/// The same with one more cell in every row.
std::string with_cell(const std::string& names, const std::string& text) {
  return csv([&](int, auto& row) { row.back() = text; }, 300, names);
}

/// The sine from one row on, later by `shift` s from row `from` on.
std::string with_gap(int from, double shift) {
  return csv(
      [=](int k, auto& row) {
        if (k >= from) row[0] = format_number(k * 0.005 + shift, 9);
      },
      600);
}

std::string utf16(const std::string& text, bool little) {
  std::string out = little ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) {
    if (!little) out += '\0';
    out += c;
    if (little) out += '\0';
  }
  return out;
}

/// Semicolons, decimal commas, and points between thousands: forces of 1.093,60 N.
std::string german() {
  std::string text = "t [s];x [mm];F [N];I [A]\n";
  for (int k = 0; k < 300; ++k) {
    std::vector<std::string> row = sine_row(k);
    const double force = 10 * *parse_number(row[2]);
    char large[32];
    std::snprintf(large, sizeof large, "%.2f", std::abs(force));
    row[2] = large;
    if (std::abs(force) >= 1000) row[2].insert(1, "T");
    if (force < 0) row[2].insert(0, "-");
    std::string line = join(row, ";");
    for (char& c : line) c = c == '.' ? ',' : c;
    for (char& c : line) c = c == 'T' ? '.' : c;
    text += line + '\n';
  }
  return text;
}

}  // namespace

TEST_CASE("currents in names are read right or asked about" * doctest::test_suite("long")) {
  const Wrong table[] = {
      {"a decimal comma",
       {{"run_0,5A.csv", passive()}},
       "inspect DIR",
       0,
       {"'0,5A' is read as 0.5 A", "1 current, 0.5 A"}},
      {"a p for the point",
       {{"run_0p5A.csv", passive()}},
       "inspect DIR",
       0,
       {"'0p5A' is read as 0.5 A", "1 current, 0.5 A"}},
      {"an underscore",
       {{"run_0_5A.csv", passive()}},
       "inspect DIR",
       1,
       {"'0_5A' may be 0.5 A or 5 A", "level: NUMBER", "run_0_5A.csv"}},
      {"no point at all",
       {{"run_05A.csv", passive()}},
       "inspect DIR",
       1,
       {"'05A' may be 5 A or 0.5 A"}},
      {"a counter before it",
       {{"run_1_5A.csv", passive()}},
       "inspect DIR",
       0,
       {"'1_5A' may be 1.5 A or 5 A: read as 5 A"}},
      {"filled up with zeros, in mA",
       {{"run_050mA.csv", passive()}},
       "inspect DIR",
       0,
       {"1 current, 0.05 A"}},
      {"two levels",
       {{"12V_0.5A.csv", passive()}},
       "inspect DIR",
       1,
       {"both 12 V (file name) and 0.5 A (file name)"}},
      {"folders",
       {{"0.5A/r.csv", passive()}, {"1A/r.csv", passive()}},
       "inspect DIR",
       0,
       {"2 currents 0.5 ... 1 A", "from folder name"}},
      {"the folder that was pointed at",
       {{"0.5A/r.csv", passive()}},
       "inspect DIR/0.5A",
       0,
       {"1 current, 0.5 A"}},
      {"a column that contradicts",
       {{"run_5A.csv", with_cell(kNames, "0.5")}},
       "inspect DIR",
       0,
       {"the recorded current is 0.5 A in the mean, the file name says 5 A: the column counts",
        "1 current, 0.5 A"}},
      {"a column beside a doubtful name",
       {{"run_0_5A.csv", with_cell(kNames, "0.5")}},
       "inspect DIR",
       0,
       {"1 current, 0.5 A", "counts, not the name"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("units are converted, or refused with the nearest ones" * doctest::test_suite("long")) {
  const Wrong table[] = {
      {"pounds",
       {{"r_1A.csv", passive("t_s,x_mm,Force (lbs)\n")}},
       "inspect DIR",
       0,
       {"lbs", "-1334...1334"}},
      {"Fahrenheit",
       {{"r.csv", with_cell("t_s,x_mm,F_N,Temperature (F)\n", "77")}},
       "inspect DIR",
       0,
       {"degF", "0.555556"}},
      {"in brackets",
       {{"r_1A.csv", passive("t_s,x_mm,F [lbx]\n")}},
       "inspect DIR",
       1,
       {"the unknown unit 'lbx' of force", "nearest: 'lbf'"}},
      {"behind an underscore",
       {{"r_1A.csv", passive("t_s,x_mm,F_KN\n")}},
       "inspect DIR",
       1,
       {"the unknown unit 'KN'", "nearest: 'kN'"}},
      {"behind a comma",
       {{"r_1A.csv", passive("t_s,x_mm,\"Force, lbsf\"\n")}},
       "inspect DIR",
       1,
       {"the unknown unit 'lbsf'", "'lbf'"}},
      {"in a row of units",
       {{"r_1A.csv", passive("t,x,F\ns,mm,lbx\n")}},
       "inspect DIR",
       1,
       {"the unknown unit 'lbx' of force"}},
      {"mass for force",
       {{"r_1A.csv", passive("t_s,x_mm,Force (kg)\n")}},
       "inspect DIR",
       1,
       {"unit 'kg' does not fit force"}},
      {"milliseconds without a unit",
       {{"r_1A.csv",
         csv([](int k, auto& row) { row[0] = std::to_string(10 * k); }, 300, "t,x_mm,F_N,i_A\n")}},
       "inspect DIR",
       1,
       {"time (t) has no unit and steps of 10", "unit: ms"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("units that workshops use are converted" * doctest::test_suite("long")) {
  const Wrong table[] = {
      {"feet, kiloponds and milliamperes",
       {{"r.csv", csv({}, 300, "t (s),x (ft),F (kp),I (mA)\n")}},
       "inspect DIR",
       0,
       {"x 0.3048", "x 9.80665", "x 0.001"}},
      {"inches, decanewtons and millivolts",
       {{"r.csv", csv({}, 300, "t (s),x (in),F (daN),U (mV)\n")}},
       "inspect DIR",
       0,
       {"x 0.0254", "x 10 ", "voltage", "x 0.001"}},
      {"minutes and micrometres",
       {{"r.csv", csv({}, 300, "t (min),x (um),F (lbf),I (A)\n")}},
       "inspect DIR",
       0,
       {"x 60", "x 1e-06", "x 4.44822"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("roles hold by themselves, and a drive that nothing tells is called unknown" *
          doctest::test_suite("long")) {
  const Wrong table[] = {
      {"roles without leave_out",
       {{"run_0A.csv", passive()},
        {"run_1A.csv", passive()},
        {"dataset.yaml",
         "files:\n  - {match: '*0A.csv', roles: [{role: training}]}\n"
         "  - {match: '*1A.csv', roles: [{role: left_out}]}\n"}},
       "identify DIR --models bingham --no-report -o DIR/out",
       0,
       {"judged by leaving out: roles"}},
      {"no drive at all",
       {{"r.csv", passive()}},
       "inspect DIR",
       0,
       {"one constant, unknown drive", "give it in the file names"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("gaps in time split a record and are never bridged") {
  const Wrong table[] = {
      {"a gap",
       {{"r.csv", with_gap(300, 1.5)}},
       "inspect DIR",
       0,
       {"r, stretch 1", "r, stretch 2", "nothing is bridged"}},
      {"a gap that would be resampled",
       {{"r.csv", with_gap(300, 1.5)},
        {"dataset.yaml", "files:\n  - match: r.csv\n    resample: 500\n"}},
       "inspect DIR",
       0,
       {"r, stretch 1", "r, stretch 2", "up to 1.5"}},
      {"a step of five", {{"r.csv", with_gap(300, 0.01)}}, "inspect DIR", 1, {"not uniform"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("folders keep their statements, and bad files stop nothing") {
  const std::string stated = "files:\n  - match: r.csv\n    level: ";
  const Wrong table[] = {
      {"two folders with dataset files",
       {{"a/r.csv", passive()},
        {"a/dataset.yaml", stated + "0.5\n"},
        {"b/r.csv", passive()},
        {"b/dataset.yaml", stated + "2\n"}},
       "inspect DIR/a DIR/b",
       0,
       {"2 currents 0.5 ... 2 A"}},
      {"a manifest of paths",
       {{"a/r.csv", passive()},
        {"b/r.csv", passive()},
        {"manifest.csv", "file,current_A\na/r.csv,0.5\nb/r.csv,2\n"}},
       "inspect DIR",
       0,
       {"2 currents 0.5 ... 2 A"}},
      {"a manifest's name that is there twice",
       {{"a/r.csv", passive()},
        {"b/r.csv", passive()},
        {"manifest.csv", "file,current_A\nr.csv,1\n"},
        {"c_1A.csv", passive()}},
       "inspect DIR",
       1,
       {"one row may be a/r.csv or b/r.csv", "write the path"}},
      {"a manifest that states a file twice",
       {{"r.csv", passive()}, {"manifest.csv", "file,current_A\nr.csv,1\nr.csv,2\n"}},
       "inspect DIR",
       1,
       {"manifest.csv:3: r.csv stands in line 2, too, with other values; one row for each file"}},
      {"the name in a template",
       {{"a/r.csv", passive()},
        {"dataset.yaml", "files:\n  - match: '*.csv'\n    level: 1\n    name: '<{stem}>'\n"}},
       "inspect DIR",
       0,
       {"<r>"}},
      {"one bad file",
       {{"a_1A.csv", passive()}, {"b_1A.csv", csv(cell(2, "abc"))}},
       "inspect DIR",
       4,
       {"not read: ", "b_1A.csv:102: force (F_N) is 'abc'", "1 record from 1 file\n"}},
      {"bad files only",
       {{"a.csv", csv(cell(2, "abc"))},
        {"b.csv", csv(drop_force, 9, "t,x,i\n")},
        {"c.csv", "words\n"}},
       "inspect DIR",
       1,
       {"no recording among 3 files", "a.csv:102", "b.csv: no column is force",
        "c.csv: it holds no table"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}

TEST_CASE("files as laboratories write them" * doctest::test_suite("long")) {
  const std::string yaml = "files:\n  - match: r.csv\n    on_bad_row: ";
  const Wrong table[] = {
      {"thousands",
       {{"r.csv", german()}},
       "inspect DIR",
       0,
       {"'.' between thousands", "-3000...3000"}},
      {"UTF-16, little end first", {{"r.csv", utf16(csv(), true)}}, "inspect DIR", 0, {"300"}},
      {"UTF-16, big end first", {{"r.csv", utf16(csv(), false)}}, "inspect DIR", 0, {"300"}},
      {"a byte order mark", {{"r.csv", "\xEF\xBB\xBF" + csv()}}, "inspect DIR", 0, {"t_s"}},
      {"an empty tail",
       {{"r.csv", csv() + "1.5,#N/A,#N/A,#N/A\n1.505,,,\n"}},
       "inspect DIR",
       0,
       {"2 rows at the end without samples left out"}},
      {"commas within numbers",
       {{"r_1A.csv", csv({}, 300, "t_s,x_mm,F_N\n")}},
       "inspect DIR",
       1,
       {"a comma within the numbers?"}},
      {"a bad row that may be dropped",
       {{"r.csv", csv(cell(2, "#N/A"))}, {"dataset.yaml", yaml + "drop\n    resample: 200\n"}},
       "inspect DIR",
       0,
       {"1 of 300 rows dropped", "('on_bad_row: drop'), at", "r.csv:"}},
      {"a bad row",
       {{"r.csv", csv(cell(2, "#N/A"))}, {"dataset.yaml", yaml + "error\n"}},
       "inspect DIR",
       1,
       {"force (F_N) is '#N/A'", "'files: [{match: \"r.csv\", on_bad_row: drop}]'"}},
      {"a bad word for it",
       {{"r.csv", csv()}, {"dataset.yaml", yaml + "skip\n"}},
       "inspect DIR",
       1,
       {"'on_bad_row' is 'skip'"}},
      {"a row twice",
       {{"r.csv", csv([](int k, auto& row) { row = sine_row(k > 99 ? k - 1 : k); })}},
       "inspect DIR",
       0,
       {"1 row with the time stamp of the row before left out", "299"}},
      {"a clock",
       {{"r.csv", csv(
                      [](int k, auto& row) {
                        char stamp[32];
                        std::snprintf(stamp, sizeof stamp, "%s:%02d.%03d",
                                      k * 5 < 1000 ? "23:59" : "00:00", (59 + k * 5 / 1000) % 60,
                                      k * 5 % 1000);
                        row[0] = stamp;
                      },
                      300, "Time,x_mm,F_N,i_A\n")}},
       "inspect DIR",
       0,
       {"times of a clock", "of the first, on behind", "1.495"}},
      {"dates",
       {{"r.csv", csv(
                      [](int k, auto& row) {
                        char stamp[40];
                        std::snprintf(stamp, sizeof stamp, "2026-11-23T10:05:%02d.%03d",
                                      k * 5 / 1000, k * 5 % 1000);
                        row[0] = stamp;
                      },
                      300, "Timestamp,x_mm,F_N,i_A\n")}},
       "inspect DIR",
       0,
       {"times of a clock", "1.495"}},
      {"a counter that wraps",
       {{"r.csv", csv([](int k, auto& row) { row[0] = std::to_string((k * 5 + 65000) % 65536); },
                      300, "t_ms,x_mm,F_N,i_A\n")}},
       "inspect DIR",
       0,
       {"starts again after 65536"}},
  };
  for (const Wrong& wrong : table) check(wrong);
}
