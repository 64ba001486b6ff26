#include "cli/program.h"
#include "damper/inverse/example_network.h"
#include "dashpot/damper/inverse/inverse_file.h"
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

TEST_CASE("export writes controllers and inverses as FMUs") {
  const TemporaryFolder folder;
  const auto preset = dashpot::inverse_network_presets().front();
  const fs::path file = folder.path() / "inverse.json";
  dashpot::save_inverse({.network = example_network(preset), .domain = {-0.02, 0.02, -0.3, 0.3, 0, 1}}, file);
  for (const auto& [words, name] :
       {std::pair{std::string("--controller mix1 --in-car"), "mix1_controller_fmi3.fmu"},
        {"--parameters spencer1997 --inverse numeric", "numeric_inverse_fmi3.fmu"},
        {"'" + file.string() + "' --name current", "current_fmi3.fmu"}}) {
    const ProgramResult result =
        run_dashpot("export " + words + " --to fmu3 --sources-only -o '" + folder.path().string() + "'");
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
    CHECK(fs::exists(folder.path() / name));
  }
}

TEST_CASE("export says which compiler an FMU lacks") {
  const TemporaryFolder folder;
  const ProgramResult result = run_dashpot("export --parameters spencer1997 --to fmu3 --compiler none -o '" +
                                           folder.path().string() + "'");
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "none: the C compiler cannot be run"));
  CHECK(contains(result.output, "--sources-only"));
}
