#include "dashpot/base/file.h"
#include "program.h"
#include "support.h"

TEST_CASE("the tour of the README runs in an empty folder, command by command" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const auto commands = shell_commands(dashpot::read_file(project_file("README.md")));
  REQUIRE(commands.size() >= 5);
  CHECK(commands.back().find("run_fmu.py") != std::string::npos);  // the path ends in another tool
  check_commands_run(commands, folder);
  CHECK(std::filesystem::exists(folder.path() / "results/report.html"));
}

TEST_CASE("the commands of the guide to suspensions run in an empty folder" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const auto commands = shell_commands(dashpot::read_file(project_file("docs/suspension.md")));
  REQUIRE(commands.size() >= 8);
  check_commands_run(commands, folder);
  for (const char* file : {"step/trace.csv", "ride/report.html"})
    CHECK(std::filesystem::exists(folder.path() / file));
}
