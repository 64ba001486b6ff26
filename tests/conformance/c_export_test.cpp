#include <algorithm>

#include "c_compile.h"
#include "damper/inverse/example_network.h"
#include "damper/kinds/narx/narx_example.h"
#include "dashpot/export/c/c_inverse.h"
#include "dashpot/export/c/c_source.h"
#include "export/example_models.h"
#include "support.h"

using namespace dashpot;

namespace {

void write_dampers(const TemporaryFolder& folder, CPrecision precision) {
  for (const ExampleModel& example : example_models())
    for (const ExportedFile& file : write_c_source(
             exported(*example.model), {.name = example.name + "_x", .precision = precision}))
      folder.write(file.name, file.content);
}

}  // namespace

TEST_CASE(
    "exported C: every kind of model in double precision gives the library's force within 1e-12" *
    doctest::test_suite("long")) {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  write_dampers(folder, CPrecision::Double);
  check_that_it_runs(folder, kAsTheTests);
}

TEST_CASE(
    "exported C: every kind of model in single precision gives it within 1e-5, without a "
    "double" *
    doctest::test_suite("long")) {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  write_dampers(folder, CPrecision::Single);
  check_that_it_runs(folder, "-Wdouble-promotion");
}

TEST_CASE("exported C: every inverse network gives the library's currents, in both precisions") {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  for (const InverseNetworkPreset& preset : inverse_network_presets())
    for (const CPrecision precision : {CPrecision::Double, CPrecision::Single}) {
      InverseFile inverse{.network = example_network(preset),
                          .domain = {-0.02, 0.02, -0.3, 0.3, 0, 1}};
      inverse.network.rate_max = 30;
      const std::string name =
          std::string(preset.name) + (precision == CPrecision::Double ? "_d" : "_s");
      for (const ExportedFile& file : write_c_block(
               c_inverse_block(inverse,
                               {.name = name, .precision = precision, .sample_time = 2.5e-3}),
               ""))
        folder.write(file.name, file.content);
    }
  check_that_it_runs(folder, kAsTheTests);
}

TEST_CASE("exported C: a test of another model's force fails") {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  const LawModel model = example_law(find_law("bouc_wen"));
  const auto moved = model.with_offset(1e-3);
  const CSource source = c_source(exported(model), {.name = "x"}),
                other = c_source(exported(*moved), {.name = "x"});
  folder.write("x.h", source.header);
  folder.write("x.c", source.source);
  folder.write("x_test.c", other.test);
  CHECK(compile_and_run(folder, "").output.find("FAILED x") != std::string::npos);
}

TEST_CASE("exported C: a NARX leaves an input that is no number out, and goes on") {
  if (!is_there("cc")) return;
  const Regressors regressors = example_regressors();
  const NarxModel model("narx_one_sensor", regressors, {example_narx_network(regressors)}, 0);
  const CSource source = c_source(exported(model), {.name = "x", .sample_time = 5e-3});

  // Two runs of one motion, one of which loses the velocity once.
  const TemporaryFolder folder;
  folder.write("x.h", source.header);
  folder.write("x.c", source.source);
  folder.write("x_test.c", R"(#include <math.h>
#include <stdio.h>
int main(void) {
  x_model whole, holed;
  double apart = 1, force = 0;
  int k;
  for (k = 0; k < 400; ++k) {
    const x_input input = {0.005 * sin(0.1 * k), 0.1 * cos(0.1 * k), 0.5};
    x_input lost = input;
    if (k == 50) lost.velocity = NAN;
    if (k == 0) x_reset(&whole, &input), x_reset(&holed, &input);
    force = x_step(&whole, &input);
    apart = fabs(x_step(&holed, &lost) - force);
    if (k == 50 && !(apart < 2000)) return 1;
  }
  printf("%g beside %g\n", apart, force);
  return apart < 1 ? 0 : 1;
}
)");
  check_that_it_runs(folder, kAsTheTests);
}

TEST_CASE("exported C: a name that the code has inside is refused") {
  const LawModel model = example_law(find_law("dahl"));
  CHECK(message_of([&] { c_source(exported(model), {.name = "dahl"}); }) ==
        "name: 'dahl' begins names that the code has inside; say 'dahl_damper'");
  CHECK(message_of([&] { c_source(exported(model), {.name = "2nd"}); }).find("letters, digits") !=
        std::string::npos);
  CHECK(c_source(exported(model), {}).prefix == "dahl_damper");
}

TEST_CASE("exported C: parameters that differ by their case alone have names of their own") {
  const auto text = parse_law_text(R"yaml(
law: two_cases
source: made up for a test
parameters:
  a: {unit: N*s/m, value: 900, bounds: [0, 1e8], form: linear, meaning: damping}
  k: {unit: N/m, value: 500, bounds: [0, 1e8], meaning: stiffness}
  K: {unit: N/m^3, value: 7, bounds: [0, 1e8], meaning: its growth}
equations:
  - "F = a*v + k*x + K*x^3"
)yaml",
                                   "two_cases.yaml");
  const LawModel model = example_law(text->law());
  const std::string header =
      write_c_source(exported(model), {.name = "x", .settable_parameters = true}).front().content;
  CAPTURE(header);
  for (const char* line : {"define X_PARAMETER_A_B 2 ", "define X_PARAMETER_k 3 ",
                           "define X_PARAMETER_K 4 ", " *   x_defaults(model.state);\n"})
    CHECK(header.find(line) != std::string::npos);
}

TEST_CASE("exported C: what cppcheck's MISRA add-on says is listed in the header" *
          doctest::test_suite("long")) {
  if (!is_there("cppcheck")) return;
  const TemporaryFolder folder;
  for (const ExampleModel& example : example_models()) {
    if (example.name != "bouc_wen" && example.name != "hysteresis_network") continue;
    const CSource source = c_source(exported(*example.model), {.name = "x"});
    folder.write("x.h", source.header);
    const auto path = folder.write("x.c", source.source);
    check_misra(path, source.header);
  }
}
