#include <filesystem>

#include "cli/program.h"
#include "dashpot/base/file.h"

using namespace dashpot;
namespace fs = std::filesystem;

TEST_CASE("closed and full streams, a reader that leaves") {
  const TemporaryFolder folder;
  const std::string results = (folder.path() / "out").string();
  const std::string fit = program_path() + " identify " + small_campaign().string() +
                          " --quiet --models bingham --output " + results;
  CHECK(run_program("( " + fit + " <&- >&- 2>&- )").exit_code == 1);
  CHECK(read_file(results + "/report.json")
            .starts_with("{"));  // the table did not go into the report

  const ProgramResult full = run_program("( " + program_path() + " inspect " +
                                         small_campaign().string() + " >/dev/full )");
  CHECK(full.exit_code == 1);
  CHECK(contains(full.output, "standard output: cannot be written"));

  fs::remove_all(results);
  const ProgramResult left =
      run_program("bash -c '" + fit + " 2>&1 | true; exit ${PIPESTATUS[0]}'");
  CHECK(left.exit_code == 128 + 13);  // SIGPIPE, as other programs do
  CHECK(left.output == "");
  CHECK(fs::exists(results + "/report.html"));
}

TEST_CASE("a reader that has left is no full disk, whatever is said on the other stream meanwhile" *
          doctest::test_suite("long")) {
  // A pipe that nobody reads; the warning of this command comes behind its result.
  const TemporaryFolder folder;
  const std::string model = (folder.path() / "fit/models/bingham.json").string(),
                    data = small_campaign().string();
  REQUIRE(run_dashpot("identify " + data + " --models bingham --quiet --output " +
                      (folder.path() / "fit").string())
              .exit_code == 0);
  folder.write("read_nothing.py",
               "import os, subprocess, sys\n"
               "reader, writer = os.pipe()\n"
               "os.close(reader)\n"
               "done = subprocess.run(sys.argv[1:], stdout=writer, stderr=subprocess.PIPE)\n"
               "print(done.stderr.decode(), 'ended with', done.returncode)\n");
  const ProgramResult result =
      run_program("/usr/bin/python3 '" + (folder.path() / "read_nothing.py").string() + "' " +
                  program_path() + " evaluate '" + model + "' " + data);
  CAPTURE(result.output);
  CHECK(contains(result.output, "these errors are no judgement"));
  CHECK(contains(result.output, "ended with 141"));
  CHECK_FALSE(contains(result.output, "disk"));
}

TEST_CASE("no HOME, a German locale, a terminal of 20 columns" * doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string rest = program_path() + " identify " + small_campaign().string() +
                           " --quiet --models bingham --output ";
  const auto report = [&](const std::string& environment, const std::string& name) {
    const ProgramResult result =
        run_program("env " + environment + " " + rest + (folder.path() / name).string());
    CHECK_MESSAGE(result.exit_code == 0, result.output);
    return read_file(folder.path() / name / "report.csv");
  };
  const std::string plain = report("COLUMNS=100", "plain");
  CHECK(report("-u HOME LANG=de_DE.UTF-8 LC_ALL=de_DE.UTF-8", "locale") == plain);
  CHECK(report("COLUMNS=20", "narrow") == plain);
}

TEST_CASE("data of Dashpot that are not there are named, not what was looked for in them") {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "plants");
  const std::string empty = folder.path().string(), none = empty + "/none";
  const ProgramResult plants = run_dashpot("simulate", "DASHPOT_DATA=" + empty);
  CHECK(plants.exit_code == 1);
  CHECK_MESSAGE(contains(plants.output, "none is found: DASHPOT_DATA may name the folder"),
                plants.output);
  const ProgramResult wrong = run_dashpot("simulate", "DASHPOT_DATA=" + none);
  CHECK(wrong.exit_code == 1);
  CHECK_MESSAGE(contains(wrong.output, "DASHPOT_DATA: '" + none + "' is no folder"), wrong.output);
  CHECK(run_dashpot("simulate --list plants", "DASHPOT_DATA=").exit_code == 0);

  // Help and the version need none of them.
  for (const char* words : {"", "--help", "--version", "simulate --help", "help rank"}) {
    const ProgramResult asked = run_dashpot(words, "DASHPOT_DATA=" + none);
    CHECK(asked.exit_code == 0);
    CHECK_MESSAGE(contains(asked.output, "'" + none + "' is no folder; passed over"), asked.output);
  }
}
