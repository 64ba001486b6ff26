#include "cli/program.h"
#include "damper/inverse/example_network.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/inverse_file.h"
#include "support.h"

namespace fs = std::filesystem;

TEST_CASE("export writes FMUs of both versions side by side") {
  const TemporaryFolder folder;
  const ProgramResult result = run_dashpot(
      "export --parameters spencer1997 --to fmu2,fmu3 --sources-only --name front -o '" +
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
  dashpot::save_inverse(
      {.network = example_network(preset), .domain = {-0.02, 0.02, -0.3, 0.3, 0, 1}}, file);
  for (const auto& [words, name] :
       {std::pair{std::string("--controller mix1 --in-car"), "mix1_controller_fmi3.fmu"},
        {"--parameters spencer1997 --inverse numeric", "numeric_inverse_fmi3.fmu"},
        {"'" + file.string() + "' --name current", "current_fmi3.fmu"}}) {
    const ProgramResult result = run_dashpot("export " + words + " --to fmu3 --sources-only -o '" +
                                             folder.path().string() + "'");
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
    CHECK(fs::exists(folder.path() / name));
  }
}

TEST_CASE("the guide's loop of a damper's and a controller's FMU runs") {
  const TemporaryFolder folder;
  const std::string page = dashpot::read_file(project_file("docs/fmu.md")), fence = "```python\n";
  const std::size_t begin = page.find(fence) + fence.size();
  folder.write("loop.py", page.substr(begin, page.find("```", begin) - begin));
  std::string commands = "cd '" + folder.path().string() + "'";
  std::size_t exports = 0;
  for (const std::string& line : dashpot::split(page, '\n'))
    if (line.starts_with("    dashpot export") && line.ends_with(" -o .") && ++exports)
      commands +=
          " && " + program_path() + line.substr(line.find(" export")) + " --compiler 'cc -O0'";
  REQUIRE(exports == 2);
  const ProgramResult result =
      run_program(commands + " && PYTHONPATH='" + project_file("examples/python") +
                  "' /usr/bin/python3 loop.py");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  // A body on a spring over a ground that moves 10 mm: 10.0 mm on a rigid damper, by the formula of
  // transmissibility 11.8 mm at 2495 N*s/m, the least that this one has.
  const double height = std::stod(result.output.substr(result.output.find("moves by ") + 9));
  CHECK(height > 10.0);
  CHECK(height < 11.8);
}

TEST_CASE("export says which compiler an FMU lacks") {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_dashpot("export --parameters spencer1997 --to fmu3 --compiler none -o '" +
                  folder.path().string() + "'");
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "none: the C compiler cannot be run"));
  CHECK(contains(result.output, "--sources-only"));
}
