#include "dashpot/base/file.h"
#include "program.h"
#include "support.h"

TEST_CASE("the tour of the README runs in a clone, as it is written" *
          doctest::test_suite("long")) {
  const TemporaryFolder clone;
  const auto commands = shell_commands(dashpot::read_file(project_file("README.md")));
  REQUIRE(commands.size() >= 5);
  CHECK(commands.back().find("run_fmu.py") != std::string::npos);  // the path ends in another tool

  // What the commands use of a clone: the program that ./run builds, and the examples.
  std::filesystem::create_directories(clone.path() / "build/release");
  std::filesystem::create_symlink(program_path(), clone.path() / "build/release/dashpot");
  std::filesystem::create_directory_symlink(project_file("examples"), clone.path() / "examples");

  // They run as one script, so that what one of them exports holds for the next.
  std::string script = "set -eu\n";
  for (const std::string& command : commands) script += command + "\n";
  dashpot::write_file(clone.path() / "tour.sh", script);
  const ProgramResult tour = run_program("cd " + clone.path().string() + " && bash tour.sh");
  CAPTURE(tour.output);
  CHECK(tour.exit_code == 0);
  CHECK(std::filesystem::exists(clone.path() / "results/fit/report.html"));
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
