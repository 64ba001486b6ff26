#include <sstream>

#include "dashpot/base/file.h"
#include "dashpot/value.h"
#include "handles.h"

using dashpot::parse_json;
using dashpot::read_file;
using dashpot::Value;

namespace {

/// Without the lines that tell the command.
std::string without_command(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);)
    if (!contains(line, "dashpot export")) kept += line + '\n';
  return kept;
}

}  // namespace

TEST_CASE("a model is exported as the program does it") {
  const TemporaryFolder folder;
  const std::string here = (folder.path() / "here").string(),
                    there = (folder.path() / "there").string();
  const Model model = published("spencer1997");
  const Value options = Value::object({{"to", Value::array(std::vector<std::string>{"c", "dpr"})},
                                       {"folder", here},
                                       {"name", "front"},
                                       {"command", "dashpot export of a test"}});
  Text report;
  REQUIRE(dashpot_export(model, dashpot::format_json(options).c_str(), &report) == DASHPOT_OK);
  const ProgramResult told = run_program(
      program_path() + " export --parameters spencer1997 --to c,dpr --name front -o " + there);
  REQUIRE(told.exit_code == 0);
  const Value told_files = parse_json(report.handle, "report");
  const std::vector<Value>& files = told_files.find("files")->items();
  REQUIRE(files.size() > 4);
  for (const Value& file : files) {
    const std::filesystem::path path = file.as_string();
    CAPTURE(path.string());
    const std::string theirs = read_file(std::filesystem::path(there) / path.filename());
    CHECK(without_command(read_file(path)) == without_command(theirs));
  }
}

TEST_CASE("files that several formats share are written and listed once") {
  const TemporaryFolder folder;
  const Value options =
      Value::object({{"to", Value::array(std::vector<std::string>{"c", "mex", "sfunction"})},
                     {"folder", folder.path().string()},
                     {"name", "front"}});
  Text report;
  REQUIRE(dashpot_export(published("spencer1997"), dashpot::format_json(options).c_str(),
                         &report) == DASHPOT_OK);
  const Value told = parse_json(report.handle, "report");
  std::vector<std::string> names;
  for (const Value& file : told.find("files")->items())
    names.push_back(std::filesystem::path(file.as_string()).filename().string());
  CHECK(names == std::vector<std::string>{"front.h", "front.c", "front_test.c", "front_mex.c",
                                          "front_sfun.c"});
}

TEST_CASE("an export that cannot be says why, and writes nothing") {
  const TemporaryFolder folder;
  const std::string into = (folder.path() / "out").string();
  const Model model = published("spencer1997");
  const auto refusal = [&](const std::string& options) {
    return message_of(
        DASHPOT_BAD_INPUT,
        dashpot_export(model, ("{\"folder\": \"" + into + "\", " + options + "}").c_str(),
                       nullptr));
  };
  CHECK(contains(refusal(R"("name": "x")"), "names no format"));
  CHECK(contains(refusal(R"("to": ["fmu4"])"), "unknown format 'fmu4'; did you mean 'fmu"));
  CHECK(contains(refusal(R"("to": ["c", "fmu3"], "compiler": "no-such-compiler")"),
                 "no-such-compiler"));
  CHECK(contains(refusal(R"("to": ["c"], "precision": "half")"), "double or float"));
  CHECK(contains(refusal(R"("to": ["c"], "name": "2fast")"), "2fast"));
  for (const char* time : {"-1", "5", "1e-30"})
    CHECK(contains(refusal((R"("to": ["c"], "sample_time": )" + std::string(time)).c_str()),
                   "sample_time: a sample time of " + std::string(time) + " s; between 1 us"));
  CHECK(contains(refusal(R"("to": ["c"], "step": 1)"), "unknown key 'step'"));
  CHECK(!std::filesystem::exists(into));
  CHECK(contains(
      message_of(DASHPOT_BAD_INPUT,
                 dashpot_export(model, R"({"to": ["c"], "folder": "/dev/null/x"})", nullptr)),
      "/dev/null/x"));
}
