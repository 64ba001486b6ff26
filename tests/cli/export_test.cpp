#include "cli/program.h"
#include "damper/inverse/example_network.h"
#include "dashpot/base/file.h"
#include "dashpot/damper/inverse/inverse_file.h"
#include "support.h"

namespace fs = std::filesystem;

TEST_CASE(
    "export writes each format of a published damper into one folder, and C that passes its own "
    "test") {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const ProgramResult result = run_program(
      program_path() + " export --parameters spencer1997 --to c,tables,dpr --precision float -o '" +
      out + "'");
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  for (const char* name : {"modified_bouc_wen_damper.h", "modified_bouc_wen_damper.c",
                           "modified_bouc_wen_damper_test.c", "modified_bouc_wen_damper_force.csv",
                           "modified_bouc_wen_damper_current.csv", "modified_bouc_wen_damper.mat",
                           "modified_bouc_wen_damper_00.dpr"})
    CHECK(fs::exists(fs::path(out) / name));
  if (run_program("cc --version").exit_code != 0) return;
  const ProgramResult check =
      run_program("cd '" + out + "' && cc -std=c99 *.c -lm -o check && ./check");
  CAPTURE(check.output);
  CHECK(check.exit_code == 0);
}

TEST_CASE("export writes ONNX, in float unless told") {
  const TemporaryFolder folder;
  const auto exported = [&](const std::string& name, const std::string& more) {
    const ProgramResult result =
        run_dashpot("export --parameters spencer1997 --to onnx --sample-time 2ms --name " + name +
                    " -o '" + folder.path().string() + "' " + more);
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
    CHECK(fs::exists(folder.path() / (name + "_rest.onnx")));
    return fs::file_size(folder.path() / (name + ".onnx"));
  };
  const auto usual = exported("usual", "");
  const double few = 50;  // bytes: metadata hold the command
  CHECK_CLOSE(static_cast<double>(exported("single", "--precision float")),
              static_cast<double>(usual), 0, few);
  CHECK(static_cast<double>(exported("wider", "--precision double")) >
        static_cast<double>(usual) + few);
}

TEST_CASE("export takes an inverse network, to what runs sample by sample") {
  const TemporaryFolder folder;
  const auto preset = dashpot::inverse_network_presets().front();
  dashpot::InverseFile inverse{.network = example_network(preset),
                               .domain = {-0.02, 0.02, -0.3, 0.3, 0, 1}};
  const fs::path file = folder.path() / "inverse.json";
  save_inverse(inverse, file);
  const std::string command =
      "export '" + file.string() + "' -o '" + folder.path().string() + "' --to ";
  const ProgramResult result = run_dashpot(command + "c --name controller");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK(fs::exists(folder.path() / "controller.c"));
  // Who uses it begins where the damper stands.
  CHECK(contains(dashpot::read_file(folder.path() / "controller.h"),
                 " *   controller_model model;\n *   controller_reset(&model, &input);\n"));
  CHECK(run_dashpot(command + "onnx --name controller").exit_code == 0);
  for (const char* name : {"controller.onnx", "controller_rest.onnx"})
    CHECK(fs::exists(folder.path() / name));
  CHECK(contains(run_dashpot(command + "dpr").output, "is an inverse, which cannot become 'dpr'"));
}

TEST_CASE(
    "export takes a vehicle's controller and a damper's inverse, to what runs sample by sample") {
  const TemporaryFolder folder;
  const std::string out = " -o '" + folder.path().string() + "'";
  CHECK(run_dashpot(
            "export --controller mix1,crossover=2Hz --in-car --sample-time 2ms --to c,onnx" + out)
            .exit_code == 0);
  CHECK(run_dashpot("export --parameters spencer1997 --inverse heaviside --to c,onnx --name rule" +
                    out)
            .exit_code == 0);
  for (const char* name :
       {"mix1_controller.h", "mix1_controller.c", "mix1_controller_test.c", "mix1_controller.onnx",
        "mix1_controller_rest.onnx", "rule.c", "rule.onnx"})
    CHECK(fs::exists(folder.path() / name));
  CHECK(contains(run_dashpot("export --controller mix1 --to dpr" + out).output,
                 "is a controller, which cannot become 'dpr'"));
  CHECK(
      contains(run_dashpot("export --controller mix2 --to c" + out).output, "did you mean 'mix1'"));
  CHECK(contains(run_dashpot("export --parameters spencer1997 --in-car --to c" + out).output,
                 "--in-car: goes with --controller"));
  CHECK(contains(
      run_dashpot("export spencer.json --controller mix1 --damper ideal --to c" + out).output,
      "another damper"));
}

TEST_CASE(
    "export of a controller or an inverse says what is known against its vehicle and damper") {
  const TemporaryFolder folder;
  const std::string to = " --to c --name x -o '" + folder.path().string() + "'";
  const auto header = [&] { return dashpot::read_file(folder.path() / "x.h"); };
  const ProgramResult controller =
      run_dashpot("export --controller skyhook --damper vrths_mr_arctan --current-max 9" + to);
  CAPTURE(controller.output);
  for (const char* text :
       {"savaresi_spelta are an example: recalled, not looked up",
        "vrths_mr_arctan: it feeds energy into motions",
        "vrths_mr_arctan: a greatest drive of 9 A is beyond what the damper is known for, 1 A"}) {
    CHECK(contains(controller.output, text));
    CHECK(contains(header(), text));
  }

  const ProgramResult inverse =
      run_dashpot("export --parameters vrths_mr_arctan --inverse heaviside --current-max 9" + to);
  CAPTURE(inverse.output);
  CHECK(contains(inverse.output, "a greatest drive of 9 A is beyond what the damper is known for"));
  for (const char* text : {"Of its damper: 1.6 kN MR damper on a press", "it feeds energy into",
                           "commands 0 ... 1 A; beyond, it extrapolates."})
    CHECK(contains(header(), text));
}

TEST_CASE("export writes no C over that of a model whose parameters can be set, nor the reverse") {
  const TemporaryFolder folder;
  const std::string words =
      "export --parameters kwok2006 -o '" + folder.path().string() + "' --to ";
  CHECK(run_dashpot(words + "c --tunable").exit_code == 0);
  CHECK(run_dashpot(words + "c --tunable").exit_code == 0);
  const ProgramResult mex = run_dashpot(words + "mex");
  CHECK(mex.exit_code == 1);
  CHECK(contains(mex.output, "is of an export with --tunable"));
  CHECK(!fs::exists(folder.path() / "tanh_kwok_damper_mex.c"));
  CHECK(run_dashpot(words + "mex --name other").exit_code == 0);
  CHECK(contains(run_dashpot(words + "c --tunable --name other").output, "without --tunable"));
}

TEST_CASE("export says what is wrong" * doctest::test_suite("long")) {
  const auto complains = [](const std::string& arguments, const std::string& of) {
    const ProgramResult result = run_dashpot("export " + arguments);
    CAPTURE(result.output);
    CHECK(result.exit_code != 0);
    CHECK(contains(result.output, of));
  };
  const std::string damper = "--parameters spencer1997 ";
  complains(damper,
            "--to: is missing; one or more of c, carsim, dpr, fmu2, fmu3, js, mex, modelica, onnx, "
            "sfunction, "
            "tables");
  complains("--to c", "needs one damper");
  complains(damper + "--to d", "unknown format 'd'");
  complains(damper + "--to c --name 2x", "cannot begin names in C");
  complains(damper + "--to c --name " + std::string(300, 'x'),
            "name: has 300 letters; at most 100");
  complains(damper + "--to c --name modified_bouc_wen", "begins names that the code has inside");
  complains(damper + "--to c --sample-time=-1ms", "sample time");
  complains(damper + "--to modelica --name record", "'record' has a meaning of its own");
  complains(damper + "--to onnx --sample-time=soon", "--sample-time");
  complains(damper + "--to c --sample-time=1",
            "a sample time of 1 s; between 1 us and 0.1 s, as 5ms");
  complains("spencer1997 --to c", "is a published damper, and no file; --parameters spencer1997");
  complains(damper + "--to c --sample-time=1e-30", "a sample time of 1e-30 s");
  complains(damper + "--to c --sample-time=0", "a sample time of 0 s");
  complains(damper + "--to onnx --precision half", "half");
  complains(damper + "--to onnx -o /proc/none", "/proc/none");
}

TEST_CASE("export --velocities: a grid in mm/s, a warning beyond the data, and wrong ones" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const std::string asked = "export --parameters spencer1997 --name d -o " + folder.path().string();
  const ProgramResult made =
      run_dashpot(asked + " --to tables,carsim --velocities=-600:300:600 --currents 0,1");
  CHECK(made.exit_code == 0);
  CHECK(contains(made.output, "the table is extrapolated beyond -500 ... 500 mm/s"));
  CHECK(contains(dashpot::read_file(folder.path() / "d_force.csv"), ",0,1\n-0.6,"));
  for (const auto& [options, words] :
       {std::pair{" --to tables --velocities 100,x", "'x' is not a number"},
        std::pair{" --to tables --velocities 0:0:100", "low:step:high"},
        std::pair{" --to tables --velocities=-500:600:50", "is a single number"},
        std::pair{" --to tables --velocities=-500:500:50", "ends at 0, not at 50: its step is 500"},
        std::pair{" --to tables --currents=0:0.3:1", "ends at 0.9, not at 1"},
        std::pair{" --to tables --currents 1,1", "holds a number twice"},
        std::pair{" --to c --velocities 100", "is the grid of tables"}}) {
    const ProgramResult wrong = run_dashpot(asked + options);
    CAPTURE(wrong.output);
    CHECK(wrong.exit_code == 2);
    CHECK(contains(wrong.output, words));
  }
}
