#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "program.h"
#include "support.h"

namespace {

/// The lines of the first ```sh block.
std::vector<std::string> tour_commands(const std::string& readme) {
  const std::string fence = "```sh\n";
  const std::size_t begin = readme.find(fence) + fence.size();
  return dashpot::split(dashpot::trim(readme.substr(begin, readme.find("```", begin) - begin)), '\n');
}

}  // namespace

TEST_CASE("the tour of the README runs in an empty folder, command by command") {
  const TemporaryFolder folder;
  const std::string readme = dashpot::read_file(project_file("README.md"));
  const auto commands = tour_commands(readme);
  REQUIRE(commands.size() >= 5);
  for (const std::string& command : commands) {
    REQUIRE(command.starts_with("dashpot "));
    const ProgramResult result =
        run_program("cd " + folder.path().string() + " && " + program_path() + " " + command.substr(8));
    CAPTURE(command);
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
  }
  CHECK(std::filesystem::exists(folder.path() / "results/report.html"));
}
