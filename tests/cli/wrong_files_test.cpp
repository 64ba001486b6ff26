#include <filesystem>

#include "dashpot/base/file.h"
#include "wrong_input.h"

using namespace dashpot;
namespace fs = std::filesystem;

TEST_CASE("links are followed once, a link to nothing and a pipe are named") {
  const TemporaryFolder folder, elsewhere;
  folder.write("a_1A.csv", csv());
  elsewhere.write("b_2A.csv", csv());
  const fs::path root = folder.path();
  fs::create_directory(root / "sub");
  fs::create_directory_symlink(root, root / "sub/up");
  fs::create_directory_symlink(elsewhere.path(), root / "linked");
  const ProgramResult loop = run_dashpot("inspect " + root.string());
  CHECK(loop.exit_code == 0);
  CHECK(contains(loop.output, "2 records from 2 files"));

  run_program("mkfifo " + (root / "pipe.csv").string());
  const ProgramResult pipe = run_dashpot("inspect " + root.string());
  CHECK(pipe.exit_code == 0);
  CHECK(contains(pipe.output, "pipe.csv: passed over: is not a regular file"));

  fs::create_symlink(root / "a_1A.csv", root / "again.csv");
  const ProgramResult twice = run_dashpot("inspect " + root.string());
  CHECK(twice.exit_code == 1);
  CHECK(contains(twice.output, "again.csv: is the same file as "));
  fs::remove(root / "again.csv");

  fs::create_symlink(root / "gone.csv", root / "dangling.csv");
  const ProgramResult dangling = run_dashpot("inspect " + root.string());
  CHECK(dangling.exit_code == 1);
  CHECK(contains(dangling.output, "dangling.csv: is a link to what is not there"));
}

TEST_CASE("several files and folders are one dataset, each file once") {
  const TemporaryFolder folder;
  const std::string a = folder.write("a_1A.csv", csv()).string(),
                    b = folder.write("more/b_2A.csv", csv()).string();
  const std::string more = (folder.path() / "more").string();
  CHECK(contains(run_dashpot("inspect " + a + " " + more).output, "2 records from 2 files"));
  const ProgramResult twice = run_dashpot("inspect " + a + " " + more + " " + b);
  CHECK(twice.exit_code == 1);
  CHECK(contains(twice.output, "is the same file as"));
}

TEST_CASE("file names that are no UTF-8 cost nobody the results") {
  const TemporaryFolder folder;
  for (const char* name : {"a\xFF_1Hz.csv", "b\xFF_2Hz.csv"}) folder.write(name, csv());
  const std::string results = (folder.path() / "out").string();
  const ProgramResult result = run_dashpot("identify " + folder.path().string() +
                                           " --models bingham --quiet --output " + results);
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK(contains(read_file(results + "/models/bingham.json"), "a\xEF\xBF\xBD_1Hz"));
}
