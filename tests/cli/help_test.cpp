#include <algorithm>
#include <sstream>

#include "dashpot/base/file.h"
#include "program.h"

namespace {

const char* const kCommands[] = {"identify",   "rank",    "search", "evaluate", "member",
                                 "inspect",    "models",  "track",  "bench",    "demo",
                                 "completion", "version", "observe"};

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);)
    longest = std::max(longest, static_cast<std::size_t>(std::ranges::count_if(
                                    line, [](char c) { return (c & 0xC0) != 0x80; })));
  return longest;
}

}  // namespace

TEST_CASE("dashpot alone welcomes and names every command") {
  const ProgramResult result = run_dashpot("");
  CHECK(result.exit_code == 0);
  for (const char* command : kCommands) CHECK(contains(result.output, command));
  CHECK(run_dashpot("--help").output == result.output);
}

TEST_CASE("every command explains itself with an example") {
  for (const char* command : kCommands) {
    CAPTURE(command);
    const ProgramResult result = run_dashpot(std::string(command) + " --help");
    CHECK(result.exit_code == 0);
    CHECK(contains(result.output, std::string("dashpot ") + command));
    CHECK(contains(result.output, "\nExample\n"));
    CHECK(run_dashpot(std::string("help ") + command).output == result.output);
  }
}

TEST_CASE("a group of commands explains itself and names its own; each has options of its own") {
  const ProgramResult group = run_dashpot("study --help");
  CHECK(group.exit_code == 0);
  for (const char* part : {"dashpot study STUDY [options]", "one-sensor", "recovery"})
    CHECK(contains(group.output, part));
  CHECK(run_dashpot("help study").output == group.output);
  const std::string recovery = run_dashpot("study recovery --help").output;
  CHECK(contains(recovery, "dashpot study recovery [options]"));
  CHECK(contains(recovery, "--repetitions"));
  CHECK_FALSE(contains(recovery, "--neurons"));
  CHECK(run_dashpot("help study recovery").output == recovery);
  CHECK(contains(run_dashpot("study one-sensor --help").output, "--neurons"));
  CHECK(contains(run_dashpot("--help-markdown").output, "\n### dashpot study one-sensor\n"));
}

TEST_CASE(
    "help keeps to the width of the terminal, but for the examples, which must be copied whole") {
  const std::string help = run_dashpot("identify --help", "COLUMNS=60").output;
  CHECK(longest_line(help.substr(0, help.find("\nExample\n"))) <= 60);
}

TEST_CASE("help prints the defaults that the program uses") {
  const std::string help = run_dashpot("identify --help").output;
  CHECK(contains(help, "(default: dashpot-results)"));
  CHECK(contains(help, "(default: record)"));
}

TEST_CASE("the documentation page names every command, and the one in docs/ is up to date") {
  const ProgramResult page = run_dashpot("--help-markdown");
  CHECK(page.output == dashpot::read_file(project_file("docs/command-line.md")));
  CHECK(page.exit_code == 0);
  for (const char* command : kCommands)
    CHECK(contains(page.output, std::string("\n## dashpot ") + command));
}

TEST_CASE("a wrong command line exits with 2 and says what would be right") {
  const struct {
    const char *arguments, *message;
  } cases[] = {
      {"idntify data", "unknown command 'idntify'; did you mean 'identify'?"},
      {"--frobnicate", "unknown option '--frobnicate'"},
      {"identify", "DATA is missing"},
      {"identify data --stars 4", "unknown option '--stars'; did you mean '--starts'?"},
      {"identify data --starts", "--starts: needs a value"},
      {"identify data --starts abc", "--starts: 'abc' is not a whole number"},
      {"identify data --starts 1.5", "--starts: '1.5' is not a whole number"},
      {"identify data --starts 0", "--starts: 0 is too small; give at least 1"},
      {"identify data --starts 99999999999", "--starts: 99999999999 is too large"},
      {"identify data --velocity-cutoff nan", "--velocity-cutoff: 'nan' is not a number"},
      {"identify data --models bimgham",
       "--models: unknown model 'bimgham'; did you mean 'bingham'?"},
      {"identify data --force-offset some", "--force-offset: unknown value 'some'"},
      {"identify data --leave-out moon", "moon"},
      {"rank", "DATA is missing"},
      {"rank data --models bingam", "--models: unknown model 'bingam'; did you mean 'bingham'?"},
      {"rank data --leave-out moon", "moon"},
      {"rank data --fresher", "unknown option '--fresher'; did you mean '--fresh'?"},
      {"study",
       "study: the subcommand is missing; known: family, one-sensor, recovery, "
       "ride-rank, suspension"},
      {"study recoveri", "unknown command 'recoveri'; did you mean 'recovery'?"},
      {"study one-sensor --repetitions 3", "unknown option '--repetitions'"},
      {"study one-sensor data --leave-out moon", "moon"},
      {"study one-sensor --models bingam",
       "--models: unknown row 'bingam'; did you mean 'bingham'?"},
      {"models bimgham", "unknown model 'bimgham'; did you mean 'bingham'?"},
      {"models bingham tanh_kwok", "one argument too many"},
      {"bench --motions 3", "--motions: '3' is not an amplitude and a frequency; write mm x Hz"},
      {"bench --levels 1,x", "--levels: 'x' is not a number"},
      {"bench --damper spencer", "unknown damper 'spencer'"},
      {"completion tcsh", "unknown shell 'tcsh'"},
  };
  for (const auto& c : cases) {
    CAPTURE(c.arguments);
    const ProgramResult result = run_dashpot(c.arguments);
    CAPTURE(result.output);
    CHECK(result.exit_code == 2);
    CHECK(contains(result.output, c.message));
    CHECK(contains(result.output, "--help' explains"));
  }
}

TEST_CASE("version") {
  CHECK(run_dashpot("version").output.starts_with("dashpot "));
  CHECK(run_dashpot("--version").output == run_dashpot("version").output);
  CHECK(contains(run_dashpot("version --json").output, "\"version\":"));
}

TEST_CASE("no colour where stdout is no terminal") {
  CHECK(!contains(run_dashpot("").output, "\x1b"));
}

TEST_CASE("a full standard output is an error") {
  const ProgramResult result = run_program("( " + program_path() + " models > /dev/full )");
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "standard output: cannot be written"));
}
