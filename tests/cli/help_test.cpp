#include <algorithm>
#include <sstream>

#include "dashpot/base/file.h"
#include "program.h"

namespace {

/// The first words of the lines below a heading, up to the next empty line.
std::vector<std::string> words_below(const std::string& heading, const std::string& text) {
  const std::size_t begin = text.find("\n" + heading + "\n");
  std::vector<std::string> words;
  if (begin == std::string::npos) return words;
  std::istringstream lines(text.substr(begin + heading.size() + 2));
  for (std::string line; std::getline(lines, line) && !line.empty();)
    if (line.starts_with("  ") && line[2] != ' ')
      words.push_back(line.substr(2, line.find(' ', 2) - 2));
  return words;
}

/// Every command, a group's own included: "rank", "study", "study recovery".
std::vector<std::string> all_commands() {
  std::vector<std::string> commands;
  for (const std::string& command : words_below("Commands", run_dashpot("").output)) {
    commands.push_back(command);
    for (const std::string& one : words_below("Subcommands", run_dashpot("help " + command).output))
      commands.push_back(command + " " + one);
  }
  return commands;
}

}  // namespace

TEST_CASE("dashpot alone welcomes and names every command") {
  const ProgramResult result = run_dashpot("");
  CHECK(result.exit_code == 0);
  for (const char* command : {"identify", "export", "version"})
    CHECK(contains(result.output, command));
  CHECK(run_dashpot("--help").output == result.output);
}

TEST_CASE("every command explains itself on one screen, with an example; topics have the rest" *
          doctest::test_suite("long")) {
  const std::vector<std::string> commands = all_commands();
  CHECK(commands.size() > 25);
  for (const std::string& command : commands) {
    CAPTURE(command);
    const std::string help = run_dashpot("help " + command, "COLUMNS=80").output;
    CHECK(contains(help, "  dashpot " + command));
    CHECK(contains(help, "\nExample\n"));
    CHECK(std::ranges::count(help, '\n') < 60);
    if (!contains(help, "\nMore options\n")) continue;

    // What is left out is named, and the example begins with its first step.
    const std::string all = run_dashpot("help " + command + " all", "COLUMNS=80").output;
    const std::size_t example = all.find("\nExample\n");
    CHECK(contains(help, all.substr(example, all.find("\n\n", example + 1) - example)));
    for (const std::string& option : words_below("Options", all)) {
      CAPTURE(option);
      CHECK((contains(help, "\n  " + option) || contains(help, option + ",") ||
             contains(help, option + "\n") || option == "-v,"));
    }
  }
}

TEST_CASE("the topics of a command explain every option that its help leaves out" *
          doctest::test_suite("long")) {
  for (const std::string command : {"identify", "export"}) {
    const std::string help = run_dashpot("help " + command).output;
    CHECK(run_dashpot(command + " --help").output == help);
    std::string pages = help;
    for (const std::string& topic : words_below("More options", help)) {
      const ProgramResult page = run_dashpot("help " + command + " " + topic);
      CHECK(page.exit_code == 0);
      pages += page.output;
    }
    for (const std::string& option :
         words_below("Options", run_dashpot("help " + command + " all").output)) {
      CAPTURE(option);
      CHECK(contains(pages, "\n  " + option));
    }
  }
}

TEST_CASE("help on a topic, on one option, and on what is neither" * doctest::test_suite("long")) {
  CHECK(run_dashpot("help identify networks").output.starts_with("How networks are built"));
  CHECK(run_dashpot("identify --help networks").output ==
        run_dashpot("help identify networks").output);
  CHECK(run_dashpot("help identify -o").output.starts_with("  -o, --output DIR"));
  CHECK(run_dashpot("help study recovery --repetitions").output.starts_with("  --repetitions"));

  // What is allowed is named in full where one asks for it.
  CHECK_FALSE(contains(run_dashpot("help identify").output, "tanh_kwok"));
  CHECK(contains(run_dashpot("help identify --models").output, "tanh_kwok"));

  const ProgramResult wrong = run_dashpot("help identify netwrks");
  CHECK(wrong.exit_code == 2);
  CHECK(contains(wrong.output, "identify: help has no topic 'netwrks'; known: all, ride, data"));
}

TEST_CASE("a group of commands explains itself and names its own; each has options of its own" *
          doctest::test_suite("long")) {
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
    "help keeps to the width of the terminal, but for the examples, which must be copied whole" *
    doctest::test_suite("long")) {
  const std::string help = run_dashpot("identify --help", "COLUMNS=60").output;
  CHECK(longest_line(help.substr(0, help.find("\nExample\n"))) <= 60);
}

TEST_CASE("help prints the defaults that the program uses" * doctest::test_suite("long")) {
  const std::string help = run_dashpot("identify --help").output;
  CHECK(contains(help, "(default: dashpot-results)"));
  CHECK(contains(run_dashpot("help identify --force-offset").output, "(default: record)"));
}

TEST_CASE("the documentation page names every command, and the one in docs/ is up to date") {
  const ProgramResult page = run_dashpot("--help-markdown");
  CHECK(page.output == dashpot::read_file(project_file("docs/command-line.md")));
  CHECK(page.exit_code == 0);
  for (const char* command : {"identify", "export", "version"})
    CHECK(contains(page.output, std::string("\n## dashpot ") + command));
}

TEST_CASE("a wrong command line exits with 2 and says what would be right" *
          doctest::test_suite("long")) {
  const struct {
    const char *arguments, *message;
  } cases[] = {
      {"idntify data", "unknown command 'idntify'; did you mean 'identify'?"},
      {"--frobnicate", "unknown option '--frobnicate'"},
      {"identify", "DATA is missing"},
      {"import data", "unknown command 'import'; did you mean 'inspect'?"},
      {"fit data", "unknown command 'fit'; did you mean 'identify'?"},
      {"identify data --stars 4", "unknown option '--stars'; did you mean '--starts'?"},
      {"identify data --starts", "--starts: needs a value"},
      {"identify data --starts abc", "--starts: 'abc' is not a whole number"},
      {"identify data --starts 1.5", "--starts: '1.5' is not a whole number"},
      {"identify data --starts 0", "--starts: 0 is too small; give at least 1"},
      {"identify data --starts 2 --starts 4", "--starts: is given 2 times; one value: 2 or 4"},
      {"bench -o a --cycles 2 --output b", "--output: is given 2 times; one value: a or b"},
      {"design passenger_car --next 0", "--next: 0 is too small; give at least 1"},
      {"identify data --starts 99999999999", "--starts: 99999999999 is too large"},
      {"identify data --velocity-cutoff nan", "--velocity-cutoff: 'nan' is not a number"},
      {"simulate model.json", "'model.json' is one argument too many; a model file as --damper"},
      {"simulate --duration 10s", "--duration: '10s' is not a number; write it as 0.25, in s"},
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
      {"studio data --port 99999", "--port: 99999 is no port; give at most 65535"},
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

TEST_CASE("version" * doctest::test_suite("long")) {
  CHECK(run_dashpot("version").output.starts_with("dashpot "));
  CHECK(run_dashpot("--version").output == run_dashpot("version").output);
  CHECK(contains(run_dashpot("version --json").output, "\"version\":"));
}

TEST_CASE("no colour where stdout is no terminal" * doctest::test_suite("long")) {
  CHECK(!contains(run_dashpot("").output, "\x1b"));
}

TEST_CASE("a full standard output is an error") {
  const ProgramResult result = run_program("( " + program_path() + " models > /dev/full )");
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "standard output: cannot be written"));
}
