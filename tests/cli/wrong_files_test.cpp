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

TEST_CASE("a file of another kind is told what it is, and what the command wants" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string recording = folder.write("a_1A.csv", csv()).string(),
                    dataset = folder.write("dataset.yaml", "files:\n  - match: a.csv\n").string(),
                    report =
                        folder.write("report.json", "{\"format\": \"dashpot report 1\"}").string(),
                    inverse = folder.write("i.json", "{\"format\": \"dashpot-inverse\"}").string(),
                    model = folder.write("m.json", "{\"format\": \"dashpot-model\"}").string(),
                    plant = project_file("data/plants/savaresi_spelta.json");
  const std::string wants = "; one that 'dashpot identify' wrote: models/NAME.json";
  const std::pair<std::string, std::string> cases[] = {
      {"evaluate " + plant + " " + recording, "is a plant, not a model file" + wants},
      {"track " + report, "report.json: is a report, not a model file" + wants},
      {"export --to c " + dataset, "dataset.yaml: is a dataset file, not a model file" + wants},
      {"member " + recording, "a_1A.csv: is no JSON, as a model file is" + wants},
      {"simulate --plant " + model, "is a model file, not a plant; one like those of data/plants"},
      {"sweep " + plant, "is a plant, not a sweep; docs/sweep.md"},
      {"design " + model, "is a model file, not a design request; docs/design.md"},
      {"physics " + model, "is a model file, not a damper description; docs/physics.md"},
      {"observe " + model + " " + recording + " --in " + plant,
       "is a plant, not a plant with its sensors; docs/in-plant.md"},
      {"models " + model, "is a model file, not the file of a law"},
      {"inspect " + report, "report.json: is a report, no recording; it reads MAT"},
      {"simulate --controller skyhook --damper spencer1997 --inverse " + model,
       "is a model file, not a file of an inverse; one that 'dashpot invert' wrote"},
      {"evaluate " + inverse + " " + recording, "is a file of an inverse, not a model file"}};
  for (const auto& [arguments, said] : cases) {
    const ProgramResult result = run_dashpot(arguments);
    CAPTURE(arguments);
    CAPTURE(result.output);
    CHECK(result.exit_code == 1);
    CHECK(contains(result.output, said));
  }
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
