#pragma once
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "dashpot/report/wrap.h"
#include "support.h"

// What the tests of the command line share.

/// The program with these arguments, in a folder of its own, with a fixed width.
inline ProgramResult run_dashpot(const std::string& arguments,
                                 const std::string& environment = "COLUMNS=100") {
  return run_program(environment + " " + program_path() + " " + arguments);
}

/// The same, but only what it prints on stdout.
inline ProgramResult stdout_of_dashpot(const std::string& arguments) {
  return run_program("( " + program_path() + " " + arguments + " 2>/dev/null )");
}

/// The columns that the widest line of a text takes.
inline std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);)
    longest = std::max(longest, dashpot::columns_of(line));
  return longest;
}

/// The lines of the ```sh blocks of a page.
inline std::vector<std::string> shell_commands(const std::string& page) {
  const std::string fence = "```sh\n";
  std::vector<std::string> commands;
  for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
    at += fence.size();
    std::istringstream block(page.substr(at, page.find("```", at) - at));
    for (std::string line; std::getline(block, line);) commands.push_back(line);
  }
  return commands;
}

/// A command as a page has it, which says "dashpot" and "python3 ../dashpot/examples/...": for
/// where we are.
inline std::string command_here(const std::string& command) {
  const std::string python = "python3 ../dashpot/";
  if (command.starts_with(python))
    return "/usr/bin/python3 " + project_file(command.substr(python.size()));
  REQUIRE(command.starts_with("dashpot "));
  return program_path() + " " + command.substr(8);
}

/// Runs them in an empty folder, one after the other.
inline void check_commands_run(const std::vector<std::string>& commands,
                               const TemporaryFolder& folder) {
  for (const std::string& command : commands) {
    const ProgramResult result =
        run_program("cd " + folder.path().string() + " && " + command_here(command));
    CAPTURE(command);
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
  }
}

/// A campaign of nine short records of a known damper (the published parameters of spencer1997),
/// made once. Small enough for tests, with enough motion to identify simple models.
inline const std::filesystem::path& small_campaign() {
  static const TemporaryFolder folder;
  static const std::filesystem::path path = [] {
    const std::filesystem::path data = folder.path() / "small";
    const ProgramResult made = run_dashpot(
        "bench --motions 15x1,10x2,5x3 --levels 0,1,2 --cycles 2 --sample-rate 200 --output " +
        data.string());
    REQUIRE_MESSAGE(made.exit_code == 0, made.output);
    return data;
  }();
  return path;
}
