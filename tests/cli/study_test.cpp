#include "dashpot/base/file.h"
#include "dashpot/base/value.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("study one-sensor on recordings: tables, a page, Markdown and JSON; again from kept fits") {
  const TemporaryFolder folder;
  const std::string command = "study one-sensor " + small_campaign().string() +
                              " --models one-sensor,two-sensors,bingham --neurons 1 --output " +
                              folder.path().string();
  const ProgramResult first = run_dashpot(command);
  CHECK(first.exit_code == 0);
  for (const char* part : {"Table 4", "8.22", "1 sensor: v, i", "report.html"})
    CHECK(contains(first.output, part));
  CHECK(contains(read_file(folder.path() / "report.html"), "\"page\":\"document\""));
  CHECK(contains(read_file(folder.path() / "report.md"), "# The one-sensor paper, repeated"));
  const ProgramResult again = stdout_of_dashpot(command + " --json");
  CHECK(parse_json(again.output, "stdout").find("format")->as_string() == "dashpot one-sensor study 1");
  CHECK(contains(run_dashpot(command).output, "kept from before"));
}
