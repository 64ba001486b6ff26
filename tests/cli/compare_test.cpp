#include <filesystem>
#include <fstream>

#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

namespace {

/// Two campaigns of one damper, and models that the first taught; made once.
struct Campaigns {
  TemporaryFolder folder;
  std::string before = (folder.path() / "before").string(),
              after = (folder.path() / "after").string(),
              models = (folder.path() / "fit" / "models").string();
};
const Campaigns& campaigns() {
  static const Campaigns all;
  static const bool made = [] {
    const std::string bench = "bench --motions 20x0.2,20x0.4,20x1,20x2 --levels 0,1 --cycles 4 ";
    for (const auto& [seed, to] : {std::pair{"1", all.before}, {"2", all.after}}) {
      const ProgramResult result =
          run_dashpot(bench + "--sample-rate 200 --seed " + seed + " --output " + to);
      REQUIRE_MESSAGE(result.exit_code == 0, result.output);
    }
    const ProgramResult fit = run_dashpot(
        "identify " + all.before + " --models bingham,tanh_kwok --starts 1 --no-report --output " +
        (all.folder.path() / "fit").string());
    REQUIRE_MESSAGE(fit.exit_code == 0, fit.output);
    return true;
  }();
  REQUIRE(made);
  return all;
}

}  // namespace

TEST_CASE("compare: two campaigns of one damper hardly differ, beside their noise" *
          doctest::test_suite("long")) {
  const Campaigns& all = campaigns();
  const ProgramResult result =
      stdout_of_dashpot("compare " + all.before + " " + all.after + " --json");
  CHECK(result.exit_code == 0);
  const Value value = parse_json(result.output, "compare --json");
  const Value& levels = *value.find("others")->items().at(0).find("levels");
  REQUIRE(levels.items().size() == 2);
  std::size_t speeds = 0;
  for (const Value& level : levels.items())
    for (const Value& speed : level.find("speeds")->items()) {
      ++speeds;
      const Value& force = *speed.find("damping_force");
      CHECK_CLOSE(force.find("second")->as_number(), force.find("first")->as_number(), 0.03, 0);
    }
  CHECK(speeds == 8);
}

TEST_CASE("compare: a model beside itself, or a copy of it, is told" *
          doctest::test_suite("long")) {
  const Campaigns& all = campaigns();
  const std::string model = all.models + "/bingham.json",
                    copy = (all.folder.path() / "copy.json").string();
  std::filesystem::copy_file(model, copy);
  for (const std::string& other : {model, copy})
    CHECK(contains(run_dashpot("compare " + model + " " + other).output,
                   "bingham.json and " + other + " are the same"));
  CHECK(!contains(run_dashpot("compare " + model + " " + all.models + "/tanh_kwok.json").output,
                  "are the same"));
}

TEST_CASE("compare: models over recordings, with fit; a warning where these taught a model" *
          doctest::test_suite("long")) {
  const Campaigns& all = campaigns();
  const std::string page = (all.folder.path() / "page.html").string();
  const std::string model = all.models + "/bingham.json";
  const ProgramResult unseen =
      run_dashpot("compare " + all.after + " " + model + " --report " + page);
  CAPTURE(unseen.output);
  CHECK(unseen.exit_code == 0);
  CHECK(contains(unseen.output, "Fit %"));
  CHECK(!contains(unseen.output, "no judgement\n"));
  CHECK(std::filesystem::file_size(page) > 1000);

  const ProgramResult seen = run_dashpot("compare " + all.before + " " + model);
  CHECK(contains(seen.output, "was taught by 8 records"));
}

TEST_CASE("compare says where recordings leave the range that a model knows" *
          doctest::test_suite("long")) {
  const Campaigns& all = campaigns();
  const TemporaryFolder folder;
  const std::string firm = (folder.path() / "firm").string();
  REQUIRE(run_dashpot("bench --motions 20x0.4,20x1 --levels 1,2 --cycles 4 --sample-rate 200 "
                      "--output " +
                      firm)
              .exit_code == 0);
  const std::string words = "compare " + firm + " " + all.models + "/bingham.json";
  const ProgramResult result = run_dashpot(words);
  CAPTURE(result.output);
  CHECK(contains(result.output, "bingham: 50 % of the samples have a voltage outside"));
  const Value json = parse_json(stdout_of_dashpot(words + " --json").output, "stdout");
  const Value& other = json.find("others")->items().front();
  CHECK(other.find("outside_domain")->items().front().find("quantity")->as_string() == "voltage");
}

TEST_CASE("compare: models alone move over the range of the first" * doctest::test_suite("long")) {
  const Campaigns& all = campaigns();
  const ProgramResult result =
      run_dashpot("compare " + all.models + "/bingham.json " + all.models + "/tanh_kwok.json");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK(contains(result.output, "tanh_kwok: "));
  CHECK(contains(result.output, "forces compared"));
}

TEST_CASE("compare refuses one thing, what is not there, and a model of another drive" *
          doctest::test_suite("long")) {
  const Campaigns& all = campaigns();
  const ProgramResult one = run_dashpot("compare " + all.before);
  CHECK(one.exit_code == 2);
  CHECK(contains(one.output, "one thing cannot be compared"));
  const ProgramResult missing = run_dashpot("compare " + all.before + " nowhere");
  CHECK(missing.exit_code == 1);
  CHECK(contains(missing.output, "nowhere"));

  std::string text = "t_s,x_mm,F_N,i_A\n";
  for (int k = 0; k < 2000; ++k)
    text += std::to_string(k / 500.0) + "," + std::to_string(10 * std::sin(6.28 * k / 500.0)) +
            "," + std::to_string(100 * std::cos(6.28 * k / 500.0)) + ",1\n";
  const std::string amperes = all.folder.write("amperes.csv", text).string();
  CHECK(run_dashpot("compare " + all.before + " " + amperes).exit_code == 1);
  CHECK(run_dashpot("compare " + amperes + " " + all.models + "/bingham.json").exit_code == 1);
}

TEST_CASE("evaluate --traces writes what was measured, modelled and left, as CSV and MAT") {
  const Campaigns& all = campaigns();
  const std::string model = all.models + "/bingham.json ";
  for (const std::string format : {"csv", "mat"}) {
    const std::string to = (all.folder.path() / ("traces-" + format)).string();
    const ProgramResult result =
        run_dashpot("evaluate " + model + all.after + " --traces " + format + " --output " + to);
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
    CHECK(contains(result.output, "(8 files)"));
    CHECK(contains(result.output, "Residuals at 99 % confidence"));
    const auto files = std::filesystem::directory_iterator(to);
    CHECK(std::distance(begin(files), end(files)) == 8);
  }

  // The residual is the difference of the other two.
  for (const auto& file : std::filesystem::directory_iterator(all.folder.path() / "traces-csv")) {
    std::ifstream lines(file.path());
    std::string line;
    std::getline(lines, line);
    CHECK(contains(line, "measured [N],modelled [N],residual [N]"));
    std::getline(lines, line);
    std::vector<double> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(std::stod(cell));
    REQUIRE(cells.size() == 7);
    CHECK_CLOSE(cells[6], cells[4] - cells[5], 1e-6, 1e-6);
  }
  CHECK(run_dashpot("evaluate " + model + all.after + " --traces xls").exit_code == 2);
}
