#include "c_compile.h"
#include "control_cases.h"
#include "support.h"

using namespace dashpot;

namespace {

std::vector<ExportedFile> exported_controller(const Vehicle& vehicle,
                                              const ExportOptions& options) {
  return write_c_block(c_controller_block(vehicle, options), "");
}

void write_controllers(const TemporaryFolder& folder, CPrecision precision) {
  for (const BlockCase& one : controller_cases())
    for (const ExportedFile& file : write_c_block(one.block({.precision = precision}), ""))
      folder.write(file.name, file.content);
}

}  // namespace

TEST_CASE("exported controllers: every law gives the library's commands within 1e-12" *
          doctest::test_suite("long")) {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  write_controllers(folder, CPrecision::Double);
  check_that_it_runs(folder, kAsTheTests);
}

TEST_CASE("exported controllers: in single precision within 1e-5, without a double" *
          doctest::test_suite("long")) {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  write_controllers(folder, CPrecision::Single);
  check_that_it_runs(folder, "-Wdouble-promotion");
}

TEST_CASE(
    "exported inverses: every scheme of dampers that suit it gives the library's currents, in both "
    "precisions" *
    doctest::test_suite("long")) {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  for (const BlockCase& one : inverse_cases())
    for (const CPrecision precision : {CPrecision::Double, CPrecision::Single}) {
      CBlock block = one.block({.precision = precision});
      block.name += precision == CPrecision::Double ? "_d" : "_s";
      for (const ExportedFile& file : write_c_block(block, ""))
        folder.write(file.name, file.content);
    }
  check_that_it_runs(folder, kAsTheTests);
}

TEST_CASE("exported inverses: without a measured force only those that need one keep the current") {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  for (const BlockCase& one : inverse_cases()) {
    if (!one.name.starts_with("bingham_") || one.name.ends_with("_lag")) continue;
    const bool needs = one.name.ends_with("optimal") || one.name.ends_with("signum");
    const std::vector<ExportedFile> files = write_c_block(one.block({}), "");
    CHECK((files[0].content.find("this scheme needs it") != std::string::npos) == needs);
    for (const ExportedFile& file : files) folder.write(file.name, file.content);

    // One with a measured force that is no number, one with a force.
    std::string test = R"(#include <math.h>
#include "x.h"
int main(void) {
  x_model with, without;
  int k, held = 0;
  x_init(&with);
  x_init(&without);
  for (k = 0; k < 100; ++k) {
    const double wave = sin(0.1 * k);
    x_input input = {800 * wave, 0.002 * wave, 0.1 * wave, 0.4, 100};
    const double right = x_step(&with, &input);
    double command;
    input.measured = (k < 50) ? NAN : 100;
    command = x_step(&without, &input);
    if (k >= 50 && command != right) return 1;
    if (k < 50 && command != right) ++held;
    if (k < 50 && NEEDS && command != 0.4) return 2;
  }
  return ((held > 0) == NEEDS) ? 0 : 3;
}
)";
    const auto put = [&](const std::string& from, const std::string& to) {
      for (std::size_t at = 0; (at = test.find(from, at)) != std::string::npos; at += to.size())
        test.replace(at, from.size(), to);
    };
    put("NEEDS", needs ? "1" : "0");
    put("x_", one.name + '_');
    put("x.h", one.name + ".h");
    folder.write(one.name + "_test.c", test);
  }
  check_that_it_runs(folder, kAsTheTests);
}

TEST_CASE("exported C ships nothing that only the library needs" * doctest::test_suite("long")) {
  std::string all;
  for (const BlockCase& one : block_cases())
    for (const ExportedFile& file : write_c_block(one.block({}), "")) all += file.content;
  for (const char* inside : {"DASHPOT_", "Declared before", "the library takes in", "\n\n\n", "@"})
    CHECK(all.find(inside) == std::string::npos);
}

TEST_CASE("exported controllers: an accelerometer is all that mix1 asks for") {
  const Vehicle vehicle = make_vehicle({.controller = "mix1", .sensors = {.in_car = true}});
  const std::vector<ExportedFile> files = exported_controller(vehicle, {});
  CHECK(files[0].name == "mix1_controller.h");
  CHECK(files[0].content.find("double body_acceleration;") != std::string::npos);
  CHECK(files[0].content.find("double deflection") == std::string::npos);
  CHECK(files[0].content.find("the deflection's by differences") == std::string::npos);
  CHECK(files[0].content.find("the body's by integration") != std::string::npos);
}

TEST_CASE("exported controllers: after a sample that is no number they go on as before") {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  for (const char* law : {"sh_add", "feb"}) {
    const Vehicle vehicle = make_vehicle({.controller = law, .sensors = {.in_car = true}});
    for (const ExportedFile& file : exported_controller(vehicle, {.name = "x"}))
      folder.write(file.name, file.content);
    folder.write(
        "x_test.c",
        R"(#include <math.h>
#include "x.h"
int main(void) {
  x_model model;
  double commands[1];
  int k, hard = 0, soft = 0;
  x_init(&model);
  for (k = 0; k < 4000; ++k) {
    x_input input = {{{0}}};
    const double wave = sin(0.03 * k) + sin(0.009 * k);
    input.struts[0].deflection = (k % 100 == 0) ? NAN : 0.01 * wave;
)" +
            std::string(std::string(law) == "feb" ? ""
                                                  : "    input.struts[0].body_acceleration = (k % "
                                                    "70 == 0) ? NAN : 3 * cos(0.03 * k);\n") +
            R"(
    x_step(&model, &input, commands);
    if (!(commands[0] >= 0 && commands[0] <= 1)) return 1;
    if (k > 2000) {
      if (commands[0] > 0.5) ++hard; else ++soft;
    }
  }
  return (hard + soft == 1999 && isfinite(model.state[0]) && isfinite(model.state[2])) ? 0 : 2;
}
)");
    CAPTURE(law);
    check_that_it_runs(folder, kAsTheTests);
  }
}

TEST_CASE("exported controllers: what cppcheck's MISRA add-on says is listed in the header" *
          doctest::test_suite("long")) {
  if (!is_there("cppcheck")) return;
  const TemporaryFolder folder;
  for (const BlockCase& one : controller_cases()) {
    if (one.name != "selector_q" && one.name != "full_car" && one.name != "spencer_numeric")
      continue;
    CAPTURE(one.name);
    const std::vector<ExportedFile> files = write_c_block(one.block({}), "");
    folder.write(files[0].name, files[0].content);
    check_misra(folder.write(files[1].name, files[1].content), files[0].content);
  }
}

TEST_CASE("a vehicle that cannot become C is refused, with what would be right") {
  CHECK(message_of([] { exported_controller(make_vehicle({}), {}); }).find("no controller") !=
        std::string::npos);
  const Vehicle vehicle = make_vehicle({.controller = "mix1"});
  CHECK(message_of([&] { exported_controller(vehicle, {.name = "mix1"}); }).empty());
  CHECK(message_of([&] { exported_controller(vehicle, {.name = "1x"}); }).find("letters") !=
        std::string::npos);
  const VehicleWords four{
      .plant = "ikenaga2000",
      .dampers = {"spencer1997", "spencer1997,motion_ratio=0.9", "spencer1997", "spencer1997"},
      .controller = "skyhook_modified",
      .inverse = "heaviside"};
  CHECK(message_of([&] {
          exported_controller(make_vehicle(four), {});
        }).find("one damper for all") != std::string::npos);
}
