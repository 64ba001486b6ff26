#include "cli/program.h"
#include "damper/inverse/example_network.h"
#include "damper/kinds/family/example_family.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/inverse_file.h"
#include "dashpot/model_file.h"
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

TEST_CASE("the guide's loop of a damper's and a controller's FMU runs" *
          doctest::test_suite("long")) {
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

TEST_CASE("export says which compiler an FMU lacks" * doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_dashpot("export --parameters spencer1997 --to fmu3 --compiler none -o '" +
                  folder.path().string() + "'");
  CHECK(result.exit_code == 1);
  CHECK(contains(result.output, "none: the C compiler cannot be run"));
  CHECK(contains(result.output, "--sources-only"));
}

TEST_CASE("the guide's loop over a tunable gap runs, from a drawing to an FMU" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  dashpot::ModelFile family;
  family.model = dashpot::example_family_physics().with_offset(0);
  family.domain = {-0.02, 0.02, -0.2, 0.2, 0, 1};
  save_model(family, folder.path() / "dashpot-results/models/family_physics.json");
  folder.write("my_damper.yaml",
               "fluid: 140CG\nbore_diameter: 15.4 mm\nrod_diameter: 4 mm\ngap: 1.2 mm\n"
               "pole_length: 7 mm\npassive_length: 0\npiston_area: 160 mm^2\n"
               "gap_area: 25 mm^2\nwire_diameter: 0.2 mm\n");
  const std::string page = dashpot::read_file(project_file("docs/family.md")),
                    fence = "```python\n";
  const std::size_t begin = page.find(fence) + fence.size();
  folder.write("loop.py", page.substr(begin, page.find("```", begin) - begin));
  std::string commands = "cd '" + folder.path().string() + "'";
  for (const char* command :
       {"dashpot member dashpot-results/models/family_physics.json --damper my_damper.yaml "
        "-o valve.json",
        "dashpot export valve.json --to fmu3 --name valve -o ."}) {
    REQUIRE(page.find(std::string("    ") + command) != std::string::npos);
    commands += " && " + program_path() + std::string(command).substr(7);
  }
  const ProgramResult result =
      run_program(commands + " --compiler 'cc -O0' && PYTHONPATH='" +
                  project_file("examples/python") + "' /usr/bin/python3 loop.py");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);

  // Less gap, more energy; the gap that was looked for lies between.
  const std::size_t at = result.output.find("a gap of ");
  REQUIRE(at != std::string::npos);
  const double gap = std::stod(result.output.substr(at + 9));
  CHECK(gap > 1.2);
  CHECK(gap < 2.7);
}

TEST_CASE("export says which damper of a family it froze, and refuses what cannot be set" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string physics = (folder.path() / "physics.json").string(),
                    gated = (folder.path() / "gated.json").string();
  dashpot::ModelFile family;
  family.domain = {-0.02, 0.02, -0.2, 0.2, 0, 1};
  family.model = dashpot::example_family_physics().with_offset(0);
  save_model(family, physics);
  family.model = dashpot::example_family().with_offset(0);
  save_model(family, gated);
  const std::string to = " --name valve -o '" + folder.path().string() + "'";
  const ProgramResult frozen = run_dashpot("export " + gated + " --to c" + to);
  CHECK(contains(frozen.output, "one damper of the family"));
  CHECK(contains(dashpot::read_file(folder.path() / "valve.h"), "gap 0.001 m"));
  CHECK(contains(run_dashpot("export " + physics + " --to c,onnx" + to).output, "of one damper"));
  CHECK(!contains(run_dashpot("export " + physics + " --to fmu3 --sources-only" + to).output,
                  "of one damper"));
  CHECK(contains(run_dashpot("export " + gated + " --to c --tunable" + to).output,
                 "nothing in it can be set"));
  CHECK(run_dashpot("export " + physics + " --to onnx --tunable" + to).exit_code == 2);

  // Tunable C: its own check runs, and its header says where each number stands.
  if (run_program("cc --version").exit_code != 0) return;
  CHECK(run_dashpot("export " + physics + " --to c --tunable" + to).exit_code == 0);
  const std::string header = dashpot::read_file(folder.path() / "valve.h");
  CHECK(contains(header, "#define VALVE_PARAMETER_GAP 6"));
  CHECK(
      contains(header, "valve_model model;\n *   valve_defaults(model.state);\n *   valve_reset("));
  CHECK(contains(header, "gap_area does not follow: set it, too"));
  const std::string at = "cd '" + folder.path().string() + "' && cc -std=c99 -Wall -Werror ";
  const ProgramResult checked =
      run_program(at + "valve.c valve_test.c -lm -o valve_test && ./valve_test");
  CHECK_MESSAGE(checked.exit_code == 0, checked.output);

  // Another gap is another member, to the bit of the library's.
  folder.write("gap.c",
               "#include \"valve.h\"\n#include <stdio.h>\nint main(void) {\n"
               "  valve_model m;\n  int k;\n  const valve_input rest = {0, 0, 1};\n"
               "  double force = 0;\n  valve_defaults(m.state);\n"
               "  m.state[VALVE_PARAMETER_GAP] = 0.0015;\n"
               "  m.state[VALVE_PARAMETER_BUILD] = -1;\n  valve_reset(&m, &rest);\n"
               "  for (k = 1; k <= 50; ++k) {\n    const valve_input i = {0, 0.001 * k, 1};\n"
               "    force = valve_advance(&m, &i, 0.001);\n  }\n"
               "  printf(\"%.17g\\n\", force);\n  return 0;\n}\n");
  const ProgramResult other = run_program(at + "valve.c gap.c -lm -o gap && ./gap");
  const auto member =
      dashpot::example_family_physics().specialised({{"gap", 0.0015}, {"build", -1}});
  std::vector<double> state(member->state_size());
  member->rest({0, 0, 1}, state);
  for (int k = 1; k <= 50; ++k)
    member->advance({0, 0.001 * (k - 1), 1}, {0, 0.001 * k, 1}, 0.001, state);
  CHECK_CLOSE(std::stod(other.output), member->force({0, 0.05, 1}, state), 1e-12, 0);
}

TEST_CASE("export says which compiler a platform needs, and what binaries are of" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string words =
      " export --parameters spencer1997 -o '" + folder.path().string() + "' --to ";
  const ProgramResult missing =
      run_program("PATH=/nonexistent " + program_path() + words + "fmu3 --platforms win64");
  CAPTURE(missing.output);
  CHECK(missing.exit_code == 1);
  CHECK(contains(missing.output, "win64: needs the compiler x86_64-w64-mingw32-gcc"));
  CHECK(contains(missing.output, "apt-get install gcc-mingw-w64-x86-64"));
  CHECK_FALSE(fs::exists(folder.path() / "modified_bouc_wen_damper_fmi3.fmu"));

  for (const std::string wrong : {"c --platforms win64", "fmu3 --platforms solaris",
                                  "fmu3 --platforms win64 --sources-only"}) {
    CAPTURE(wrong);
    CHECK(run_program(program_path() + words + wrong).exit_code == 2);
  }
}
