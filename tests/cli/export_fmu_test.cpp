#include "cli/program.h"
#include "support.h"

namespace fs = std::filesystem;

TEST_CASE("export writes FMUs of both versions side by side") {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_dashpot("export --parameters spencer1997 --to fmu2,fmu3 --sources-only --name front -o '" +
                  folder.path().string() + "'");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK(fs::exists(folder.path() / "front_fmi2.fmu"));
  CHECK(fs::exists(folder.path() / "front_fmi3.fmu"));
}

TEST_CASE("export says which compiler an FMU lacks") {
  const TemporaryFolder folder;
  const ProgramResult result = run_dashpot("export --parameters spencer1997 --to fmu3 --compiler none -o '" +
                                           folder.path().string() + "'");
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "none: the C compiler cannot be run"));
  CHECK(contains(result.output, "--sources-only"));
}
