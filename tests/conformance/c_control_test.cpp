#include "c_compile.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/registry.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/output/exporters/c_controller.h"
#include "dashpot/output/exporters/c_inverse.h"
#include "output/exporters/example_models.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A controller on a vehicle, with a name in C.
struct Case {
  std::string name;
  VehicleWords words;
};

/// Every law on a quarter car, with true signals and with a car's sensors; laws of the whole plant on a full
/// car; the ways from a force to a current.
std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&](std::string name, VehicleWords words) {
    words.sample_time = 2e-3;
    all.push_back({std::move(name), std::move(words)});
  };
  for (const ControlLaw* law : control_laws()) {
    add(std::string(law->name) + "_q", {.controller = std::string(law->name)});
    if (law->needs_plant_state) continue;
    add(std::string(law->name) + "_car", {.controller = std::string(law->name), .sensors = {.in_car = true}});
  }
  add("selector_q",
      {.controller = "selector(skyhook_modified/feb),crossover=3Hz", .sensors = {.in_car = true}});
  add("twice_q", {.controller = "selector(feb/feb)"});
  add("full_car", {.plant = "ikenaga2000", .dampers = {"ideal"}, .controller = "clipped_lqr,force=1e-8"});
  add("full_skyhook",
      {.plant = "ikenaga2000", .dampers = {"ideal"}, .controller = "feb", .sensors = {.in_car = true}});
  for (const char* inverse :
       {"numeric", "heaviside", "signum", "modified_clipped_optimal", "clipped_optimal"})
    add(std::string("spencer_") + inverse,
        {.dampers = {"spencer1997,motion_ratio=0.8"}, .controller = "skyhook_modified", .inverse = inverse});
  add("spencer_loop", {.dampers = {"spencer1997,motion_ratio=0.8"},
                       .controller = "skyhook_modified",
                       .inverse = "numeric",
                       .force_loop = "proportional=0.2,integral=5,derivative=1e-4"});
  return all;
}

void write_all(const TemporaryFolder& folder, CPrecision precision) {
  for (const Case& one : cases())
    for (const ExportedFile& file :
         write_c_controller(make_vehicle(one.words), {.name = one.name, .precision = precision}))
      folder.write(file.name, file.content);
}

}  // namespace

TEST_CASE("exported controllers: every law gives the library's commands within 1e-12") {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  write_all(folder, CPrecision::Double);
  check_that_it_runs(folder, kAsTheTests);
}

TEST_CASE("exported controllers: in single precision within 1e-5, without a double") {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  write_all(folder, CPrecision::Single);
  check_that_it_runs(folder, "-Wdouble-promotion");
}

TEST_CASE(
    "exported inverses: every scheme of dampers that suit it gives the library's currents, in both "
    "precisions") {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  for (const char* damper : {"bingham", "bouc_wen"})
    for (const InverseScheme& scheme : inverse_schemes()) {
      if (scheme.name == "polynomial" && std::string(damper) == "bouc_wen") continue;
      for (const double lag : {0.0, 60.0}) {
        if (scheme.name.starts_with("neural") && (lag > 0 || std::string(damper) == "bouc_wen")) continue;
        const LawModel model = example_law(find_law(damper));
        const auto inverse = scheme.make(model, {0, 2, 1e-3, lag});
        for (const CPrecision precision : {CPrecision::Double, CPrecision::Single}) {
          const std::string name = std::string(damper) + "_" + std::string(scheme.name) +
                                   (lag > 0 ? "_lag" : "") + (precision == CPrecision::Double ? "_d" : "_s");
          for (const ExportedFile& file :
               write_c_inverse({.model = *inverse, .title = name, .domain = {-0.02, 0.02, -0.3, 0.3, 0, 2}},
                               {.name = name, .precision = precision}))
            folder.write(file.name, file.content);
        }
      }
    }
  check_that_it_runs(folder, kAsTheTests);
}

TEST_CASE("exported C ships nothing that only the library needs") {
  std::string all;
  for (const Case& one : cases())
    for (const ExportedFile& file : write_c_controller(make_vehicle(one.words), {.name = one.name}))
      all += file.content;
  const LawModel model = example_law(find_law("bouc_wen"));
  const auto inverse = find_inverse("numeric").make(model, {});
  for (const ExportedFile& file :
       write_c_inverse({.model = *inverse, .domain = {-0.02, 0.02, -0.3, 0.3, 0, 2}}, {}))
    all += file.content;
  for (const char* inside : {"DASHPOT_", "Declared before", "the library takes in", "\n\n\n", "@"})
    CHECK(all.find(inside) == std::string::npos);
}

TEST_CASE("exported controllers: an accelerometer is all that mix1 asks for") {
  const Vehicle vehicle = make_vehicle({.controller = "mix1", .sensors = {.in_car = true}});
  const std::vector<ExportedFile> files = write_c_controller(vehicle, {});
  CHECK(files[0].name == "mix1_controller.h");
  CHECK(files[0].content.find("double body_acceleration;") != std::string::npos);
  CHECK(files[0].content.find("double deflection") == std::string::npos);
}

TEST_CASE("exported controllers: after a sample that is no number they go on as before") {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  for (const char* law : {"sh_add", "feb"}) {
    const Vehicle vehicle = make_vehicle({.controller = law, .sensors = {.in_car = true}});
    for (const ExportedFile& file : write_c_controller(vehicle, {.name = "x"}))
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
            std::string(
                std::string(law) == "feb"
                    ? ""
                    : "    input.struts[0].body_acceleration = (k % 70 == 0) ? NAN : 3 * cos(0.03 * k);\n") +
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

TEST_CASE("exported controllers: what cppcheck's MISRA add-on says is listed in the header") {
  if (!is_there("cppcheck")) return;
  const TemporaryFolder folder;
  for (const Case& one : cases()) {
    if (one.name != "selector_q" && one.name != "full_car" && one.name != "spencer_numeric") continue;
    CAPTURE(one.name);
    const std::vector<ExportedFile> files = write_c_controller(make_vehicle(one.words), {.name = "x"});
    folder.write("x.h", files[0].content);
    check_misra(folder.write("x.c", files[1].content), files[0].content);
  }
}

TEST_CASE("a vehicle that cannot become C is refused, with what would be right") {
  CHECK(message_of([] { write_c_controller(make_vehicle({}), {}); }).find("no controller") !=
        std::string::npos);
  const Vehicle vehicle = make_vehicle({.controller = "mix1"});
  CHECK(message_of([&] { write_c_controller(vehicle, {.name = "mix1"}); }).empty());
  CHECK(message_of([&] { write_c_controller(vehicle, {.name = "1x"}); }).find("letters") !=
        std::string::npos);
  const VehicleWords four{
      .plant = "ikenaga2000",
      .dampers = {"spencer1997", "spencer1997,motion_ratio=0.9", "spencer1997", "spencer1997"},
      .controller = "skyhook_modified",
      .inverse = "heaviside"};
  CHECK(message_of([&] { write_c_controller(make_vehicle(four), {}); }).find("one damper for all") !=
        std::string::npos);
}
