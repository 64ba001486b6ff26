#include <cmath>
#include <map>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;
namespace fs = std::filesystem;

namespace {

using Cells = std::vector<std::vector<std::string>>;

Cells cells_of(const fs::path& file) {
  Cells cells;
  for (const std::string& line : split(read_file(file), '\n'))
    if (!line.empty()) cells.push_back(split(line, ','));
  return cells;
}

void works(const std::string& arguments) {
  const ProgramResult result = run_dashpot(arguments);
  CAPTURE(arguments);
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
}

/// Checks every number of two files against the ratio of the units in its title.
void check_ratios(const Cells& si, const Cells& pounds) {
  constexpr double kPound = 4.4482216152605, kInch = 0.0254;
  const std::map<std::string, double> ratios{{"lbf", 1 / kPound},
                                             {"in", 1 / kInch},
                                             {"in/s", 1 / kInch},
                                             {"in/s^2", 1 / kInch},
                                             {"lbf/in", kInch / kPound},
                                             {"lbf s/in", kInch / kPound},
                                             {"lbf in", 1 / (kPound * kInch)}};
  REQUIRE(si.size() == pounds.size());
  std::size_t compared = 0;
  for (std::size_t c = 0; c < pounds[0].size(); ++c) {
    const std::string& title = pounds[0][c];
    const std::size_t open = title.find('[');
    const std::string unit =
        open == std::string::npos ? "" : title.substr(open + 1, title.find(']') - open - 1);
    CAPTURE(title);
    for (const std::string metric : {"N", "m", "m/s", "J", "N/m", "N*s/m"}) CHECK(unit != metric);
    for (std::size_t row = 1; row < si.size(); ++row) {
      // From the end of the line, since the name of a record may hold commas.
      const std::size_t place = si[row].size() + c - pounds[0].size();
      const auto a = parse_number(si[row][place]), b = parse_number(pounds[row][place]);
      const auto ratio = ratios.find(unit);
      if (!a || !b || ratio == ratios.end()) continue;
      CHECK(*b == doctest::Approx(ratio->second * *a).epsilon(1e-8).scale(1e-9));
      ++compared;
    }
  }
  CHECK(compared > 0);
}

}  // namespace

TEST_CASE("CSV files in pounds and inches are those in SI times the ratio of their units" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string to = folder.path().string(), data = small_campaign().string(),
                    pounds = " --units lbf,in/s";
  works("characterise " + data + " --csv " + to + "/si.csv");
  works("characterise " + data + " --csv " + to + "/pounds.csv" + pounds);
  check_ratios(cells_of(to + "/si.csv"), cells_of(to + "/pounds.csv"));
  const std::string ride = "simulate --duration 2 --output " + to;
  works(ride + "/ride");
  works(ride + "/pounds" + pounds);
  check_ratios(cells_of(to + "/ride/trace.csv"), cells_of(to + "/pounds/trace.csv"));
}

TEST_CASE("a bench in pounds and inches is read as the same recordings" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string to = folder.path().string(),
                    bench = "bench --motions 10x1 --levels 1 --cycles 2 --sample-rate 200 -o " + to;
  works(bench + "/a");
  works(bench + "/b --units lbf,in/s");
  const auto sheet = [&](const std::string& name) {
    return parse_json(stdout_of_dashpot("characterise " + to + name + " --json").output, name);
  };
  const auto force = [](const Value& all) {
    return all.find("levels")->items().at(0).find("gas_force")->find("value")->as_number();
  };
  CHECK(contains(read_file(to + "/b/10_mm_1_Hz_1_V.csv"), "t_s,x_in,F_lbf,voltage_V"));
  CHECK(force(sheet("/a")) == doctest::Approx(force(sheet("/b"))).epsilon(1e-4));
}

TEST_CASE("tables are exported in the units of their grid") {
  const TemporaryFolder folder;
  const std::string to = folder.path().string(),
                    tables = "export --parameters spencer1997 --to tables --currents 0,1 -o " + to;
  works(tables + "/pounds --units lbf,in/s --velocities=-2,0,2");
  works(tables + "/si --velocities=-50.8,0,50.8");
  const Cells pounds = cells_of(to + "/pounds/modified_bouc_wen_damper_force.csv"),
              si = cells_of(to + "/si/modified_bouc_wen_damper_force.csv");
  CHECK(pounds[0][0].starts_with("force[lbf]: velocity[in/s] \\ current[V]"));
  CHECK(pounds[1][0] == "-2");
  for (std::size_t row = 1; row < si.size(); ++row)
    for (std::size_t c = 1; c < si[row].size(); ++c)
      CHECK(4.4482216152605 * *parse_number(pounds[row][c]) ==
            doctest::Approx(*parse_number(si[row][c])).epsilon(1e-12));

  const ProgramResult c = run_dashpot("export --parameters spencer1997 --to c --units lbf,in/s");
  CHECK(c.exit_code == 2);
  CHECK(contains(c.output, "--units: are of tables"));
}

TEST_CASE("units that are none are refused as wrong usage") {
  for (const std::string command : {"characterise", "inspect", "evaluate model.json", "identify"}) {
    const ProgramResult result =
        run_dashpot(command + " " + small_campaign().string() + " --units lbf");
    CAPTURE(result.output);
    CHECK(result.exit_code == 2);
    CHECK(contains(result.output, "as N,mm/s or lbf,in/s"));
  }
}
