#include <tuple>

#include "dashpot/base/file.h"
#include "dashpot/value.h"
#include "identify/family_example.h"
#include "program.h"

using namespace dashpot;

namespace {

/// A family of dampers as the family paper's authors publish theirs: a file of records, and one of
/// inputs.
std::filesystem::path write_family(const TemporaryFolder& folder) {
  Value records = Value::object(), inputs = Value::object();
  const Dataset family = small_family();
  for (std::size_t r = 0; r < family.records.size(); r += 2) {
    Value levels = Value::array(), yield = Value::array();
    for (const Record* record : {&family.records[r], &family.records[r + 1]}) {
      Value level = Value::object({{"time", Value::array(record->time)}});
      for (const auto& [key, name, per_si] :
           {std::tuple("displace", "displacement", 1e3), std::tuple("velocity", "velocity", 1e3),
            std::tuple("force", "force", 1.0)}) {
        std::vector<double> samples = record->channel(name).samples;
        for (double& sample : samples) sample *= per_si;
        level.add(key, Value::array(samples));
      }
      levels.push_back(std::move(level));
      yield.push_back(record->conditions.back().second);
    }
    const auto& c = family.records[r].conditions;
    const std::string damper = "damper" + std::to_string(r);
    records.add(damper, std::move(levels));
    inputs.add(damper, Value::object({{"viscocidad", c[0].second},
                                      {"Ap", c[1].second},
                                      {"Ag", c[2].second},
                                      {"h", c[3].second},
                                      {"L", c[4].second},
                                      {"Ty", std::move(yield)}}));
  }
  folder.write("inp_family.json", format_json(inputs));
  return folder.write("family.json", format_json(records));
}

}  // namespace

TEST_CASE(
    "study one-sensor on recordings: tables, a page, Markdown and JSON; again from kept fits" *
    doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string command = "study one-sensor " + small_campaign().string() +
                              " --models one-sensor,two-sensors,bingham --neurons 1 --output " +
                              folder.path().string();
  const ProgramResult first = run_dashpot(command);
  CHECK(first.exit_code == 0);
  for (const char* part : {"Table 4", "8.22", "1 sensor: v, i", "report.html"})
    CHECK(contains(first.output, part));
  CHECK(contains(read_file(folder.path() / "report.html"), "Table 4"));
  CHECK(contains(read_file(folder.path() / "report.md"), "# The one-sensor paper, repeated"));
  const ProgramResult again = stdout_of_dashpot(command + " --json");
  CHECK(parse_json(again.output, "stdout").find("format")->as_string() ==
        "dashpot one-sensor study 1");
  CHECK(contains(run_dashpot(command).output, "kept from before"));
}

TEST_CASE("study recovery: each law once, and no verdict on few intervals") {
  const ProgramResult result = run_dashpot("study recovery --laws bingham,bingham --repetitions 2");
  CHECK(result.exit_code == 3);
  const std::string row = "| bingham | 10 |";
  CHECK(contains(result.output, row));
  CHECK(result.output.find(row) == result.output.rfind(row));
  CHECK(contains(result.output, "too few to tell"));
  CHECK(contains(result.output, "too few intervals to tell: bingham; more --repetitions"));
  CHECK(!contains(result.output, "NOT TRUSTWORTHY"));
  CHECK(contains(run_dashpot("study recovery --noise 0").output, "there is no error to state"));
}

TEST_CASE("studies: what no study can end is refused, with the study's own help") {
  const ProgramResult large = run_dashpot("study one-sensor --neurons 1000000000");
  CHECK(large.exit_code == 2);
  CHECK(contains(large.output, "--neurons: 1000000000 is too large; at most 1000"));
  CHECK(contains(large.output, "'dashpot study one-sensor --help' explains."));
  CHECK(contains(run_dashpot("study two-sensors").output, "'dashpot study --help' explains."));
}

TEST_CASE(
    "study family: tables, a page, Markdown and JSON; again from kept trainings; other data is "
    "refused") {
  const TemporaryFolder folder;
  const std::string output = " --output " + (folder.path() / "out").string();
  CHECK(contains(run_dashpot("study family " + small_campaign().string() + output).output,
                 "has no condition 'piston_area'"));
  const std::string command =
      "study family " + write_family(folder).string() + " --seeds 1 --effort 0.002" + output;
  const std::filesystem::path older = folder.write("out/fits/0123456789abcdef01234567.json",
                                                   "{\"format\": \"dashpot training 1\"}");
  const ProgramResult first = run_dashpot(command);
  CAPTURE(first.output);
  CHECK(first.exit_code == 0);
  CHECK(contains(first.output, "holds trainings of an older version of Dashpot"));
  CHECK(read_file(older) == "{\"format\": \"dashpot training 1\"}");
  for (const char* part : {"16 records", "Each geometry", "report.html"})
    CHECK(contains(first.output, part));

  // Of other recordings than the paper's, nothing is said that the paper says of its own.
  const std::string page = read_file(folder.path() / "out/report.md");
  CHECK(contains(page, "# A family of dampers"));
  for (const char* part : {"0.5115", "0.714 N", "0.9577", "Figure 9", "37 ms"})
    CHECK(!contains(first.output + page, part));
  const ProgramResult again = run_dashpot(command + " --json 2>&1");
  CHECK(contains(again.output, "dashpot family study 1"));
  CHECK(contains(again.output, "trainings kept from before"));
}
