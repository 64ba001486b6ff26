#include <filesystem>
#include <fstream>
#include <numbers>

#include "dashpot/base/text.h"
#include "dashpot/report/wrap.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

namespace {

/// A multi-speed file as dynos write it: one stroke, ever faster, in mm and N; F = 20 N friction
/// and 2000 N*s/m, 100 N of gas.
std::string multi_speed_csv() {
  std::string text = "t_s,x_mm,F_N,T_degC\n";
  double phase = -2.5, t = 0;
  for (const double hz : {0.1, 0.2, 0.4, 0.8, 1.6, 2.4})
    for (double done = 0; done < 2 * std::numbers::pi * 3;) {
      const double step = 2 * std::numbers::pi * hz / 500;
      phase += step;
      done += step;
      const double v = 0.02 * 2 * std::numbers::pi * hz * std::cos(phase);
      text += std::to_string(t) + "," + std::to_string(20 * std::sin(phase)) + "," +
              std::to_string(2000 * v + (v > 0 ? 20 : -20) - 100) + ",25\n";
      t += 0.002;
    }
  return text;
}

}  // namespace

TEST_CASE("characterise prints a sheet within 80 columns, and writes cycles and a page") {
  const TemporaryFolder folder;
  const std::string file = folder.write("run_0.5A.csv", multi_speed_csv()).string(),
                    csv = (folder.path() / "cycles.csv").string(),
                    page = (folder.path() / "sheet.html").string();
  const ProgramResult result =
      run_dashpot("characterise " + file + " --csv " + csv + " --report " + page, "env -u COLUMNS");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  for (const char* part : {"0.5 A", "Friction N", "Knee", "Drift %", "1 record"})
    CHECK(contains(result.output, part));
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);)
    if (!contains(line, folder.path().string())) CHECK(columns_of(line) <= 80);
  CHECK(std::filesystem::file_size(page) > 1000);
  std::ifstream cycles(csv);
  std::string head;
  std::getline(cycles, head);
  CHECK(contains(head, "record,start[s]"));
  CHECK(contains(head, "gas_force[N]"));
}

TEST_CASE("characterise --json is in SI and has every level; --speeds asks for others") {
  const TemporaryFolder folder;
  const std::string file = folder.write("run_0.5A.csv", multi_speed_csv()).string();
  const Value value =
      parse_json(stdout_of_dashpot("characterise " + file + " --json").output, "json");
  const Value& level = value.find("levels")->items().at(0);
  CHECK_CLOSE(level.find("friction")->find("value")->as_number(), 20, 0.05, 0);
  CHECK_CLOSE(level.find("gas_force")->find("value")->as_number(), 100, 0.02, 0);
  CHECK(level.find("knee_rebound")->find("speed")->find("value")->is_null());
  CHECK(level.find("speeds")->items().size() == 6);

  const ProgramResult stated = run_dashpot("characterise " + file + " --speeds 100,5000");
  // 2000 N*s/m * 0.1 m/s + 20 N, and 100 N of gas.
  CHECK(contains(stated.output, "120      -320"));
  for (const char* row : {"0.5 A  5000", "0.5 A  5e+03"}) CHECK(!contains(stated.output, row));
}

TEST_CASE("characterise names the stated speeds that no level has, and one speed once") {
  const TemporaryFolder folder;
  const std::string file = folder.write("run_0.5A.csv", multi_speed_csv()).string();
  const ProgramResult beyond = run_dashpot("characterise " + file + " --speeds 50,1000,2000");
  CHECK_MESSAGE(contains(beyond.output, "no force is stated at 1000, 2000 mm/s: beyond"),
                beyond.output);
  CHECK_FALSE(contains(run_dashpot("characterise " + file + " --speeds 50").output, "beyond the"));

  const std::vector<std::string> lines = split(multi_speed_csv(), '\n');
  std::string slowest;
  for (std::size_t k = 0; k < 14000; ++k) slowest += lines[k] + '\n';
  const ProgramResult one =
      run_dashpot("characterise " + folder.write("one_0.5A.csv", slowest).string());
  CHECK_MESSAGE(contains(one.output, "cycles in 1 of 1 record; 12.5 mm/s"), one.output);
}

TEST_CASE("characterise warns where the recordings are of several dampers") {
  const TemporaryFolder folder;
  folder.write("a.csv", multi_speed_csv());
  folder.write("b.csv", multi_speed_csv());
  const std::string several = "are of 2 dampers by their drawings";
  const auto told_of = [&](const std::string& gap) {
    folder.write("dataset.yaml",
                 "drive: none\nfiles:\n  - {match: a.csv, conditions: {gap: 1 mm}}\n"
                 "  - {match: b.csv, conditions: {gap: " +
                     gap + "}}\n");
    return run_dashpot("characterise " + folder.path().string()).output;
  };
  CHECK(contains(told_of("2 mm"), several));
  CHECK_FALSE(contains(told_of("1 mm"), several));
}

TEST_CASE("characterise refuses speeds that are none, and says where there is no cycle") {
  const TemporaryFolder folder;
  const std::string file = folder.write("run_0.5A.csv", multi_speed_csv()).string();
  const ProgramResult wrong = run_dashpot("characterise " + file + " --speeds 50,fast");
  CHECK(wrong.exit_code == 2);
  CHECK(contains(wrong.output, "'fast' is not a speed"));
  CHECK(contains(wrong.output, "mm/s"));
  CHECK(run_dashpot("characterise " + file + " --speeds -3").exit_code == 2);

  // Nor does it begin where what it is to write has no place.
  for (const std::string option : {" --report ", " --csv "}) {
    const ProgramResult placeless = run_dashpot("characterise nowhere" + option + "/dev/null");
    CAPTURE(placeless.output);
    CHECK(placeless.exit_code == 1);
    CHECK(contains(placeless.output, "/dev/null: cannot be written: it is no regular file"));
  }

  std::string rest = "t_s,x_mm,F_N\n";
  for (int k = 0; k < 500; ++k) rest += std::to_string(k * 0.002) + ",3,100\n";
  const ProgramResult still =
      run_dashpot("characterise " + folder.write("rest_1A.csv", rest).string());
  CAPTURE(still.output);
  CHECK(still.exit_code == 3);
  CHECK(contains(still.output, "at rest"));
}
