#include "dashpot/physics/fluid.h"

#include <cmath>

#include "dashpot/physics/damper_physics.h"
#include "support.h"

using namespace dashpot;

TEST_CASE(
    "Carlson's yield stress and flux density are those of TC-5.4, and the field for a flux density "
    "is the "
    "inverse") {
  struct Row {
    const char* fluid;
    double stress[3], flux_density[3];
  };
  const Row rows[] = {
      {"122EG", {8283.4174, 15145.526, 23057.32}, {0.23394204, 0.38266174, 0.5730757}},
      {"132DG", {14661.88, 26808.005, 40812.101}, {0.32443677, 0.51857981, 0.74323811}},
      {"140CG", {20600.172, 37665.667, 57341.642}, {0.39968837, 0.63160354, 0.884738}}};
  for (const Row& row : rows) {
    const double phi = find_fluid(row.fluid)->law("carlson")->volume_fraction;
    for (int k = 0; k < 3; ++k) {
      const double field = 50e3 * (1 << k);
      CHECK_CLOSE(carlson_yield_stress(phi, 1, field), row.stress[k], 3e-8, 0);
      CHECK_CLOSE(carlson_yield_stress(phi, 0.95, field), 0.95 * row.stress[k], 3e-8, 0);
      CHECK_CLOSE(carlson_flux_density(phi, field), row.flux_density[k], 2e-8, 0);
      CHECK_CLOSE(carlson_field(phi, carlson_flux_density(phi, field)), field, 1e-12, 0);
    }
  }
  CHECK(carlson_field(0.3, 0) == 0);
}

TEST_CASE("the family paper's table 1 gives TC-5.4b, holds its maximum, and says so") {
  struct Row {
    const char* fluid;
    double flux_density, field, stress;
  };
  const Row rows[] = {{"122EG", 0.5, 142443.62, 9678.505},
                      {"140CG", 0.5, 51694.5, 26976.087},
                      {"122EG", 0.1, 23550.365, 4811.4015},
                      {"140CG", 0.1, 7466.484, 6444.6876}};
  for (const Row& row : rows) {
    const FluidLaw* law = find_fluid(row.fluid)->law("paper");
    CHECK_CLOSE(law->field(row.flux_density), row.field, 4e-8, 0);
    CHECK_CLOSE(family_field(&law->polynomial, -row.flux_density), -row.field, 4e-8, 0);
    CHECK_CLOSE(law->yield_stress(row.field, 1), row.stress, 6e-8, 0);
  }
  for (const double field : {218.759e3, 470.329e3, 1000e3})
    CHECK_CLOSE(find_fluid("140CG")->law("paper")->yield_stress(field, 1), 59456.1, 1e-6, 0);

  const auto warnings = [](const std::string& fluid, double field) {
    DamperDescription damper = parse_description(
        "fluid: " + fluid + "\nyield: paper\ncircuit: paper\npassive_length: 0\n", "test.yaml");
    DamperPhysics physics;
    physics.field = field;
    return physics_warnings(damper, physics);
  };
  CHECK(warnings("140CG", 200e3).size() == 1);
  CHECK(warnings("140CG", 300e3).at(1).find("is held at 59.46 kPa above 218.8 kA/m") !=
        std::string::npos);
  CHECK(warnings("122EG", 100e3).at(0).find("factor of 2 to 2.7") != std::string::npos);
}

TEST_CASE("the polynomial of 122EG turns where it is held; its measured points rise and are held") {
  const FamilyFluid& table = find_fluid("122EG")->law("paper")->polynomial;
  const double top = table.held_field;
  CHECK(family_yield_stress(&table, 0.99 * top) < family_yield_stress(&table, top));
  CHECK_CLOSE(table.yield[1] + top * (2 * table.yield[2] + top * 3 * table.yield[3]), 0, 0, 1e-4);
  const FluidLaw& measured = *find_fluid("122EG")->law("data_set");
  CHECK(measured.yield_stress(0, 1) == 779.93);
  CHECK_CLOSE(measured.yield_stress(102.83e3, 1), 21101.58, 1e-12, 0);
  CHECK_CLOSE(measured.yield_stress(145.63e3, 1), (21101.58 + 30174.10) / 2, 1e-12, 0);
  CHECK(measured.yield_stress(1e6, 1) == 33500);
}

TEST_CASE("the file of 140CG has the numbers of the law field_chain to the bit") {
  const FamilyFluid &file = find_fluid("140CG")->law("paper")->polynomial, &law = kFamily140CG;
  for (int k = 0; k < 2; ++k) CHECK(file.field[k] == law.field[k]);
  for (int k = 0; k < 4; ++k) CHECK(file.yield[k] == law.yield[k]);
  CHECK(file.held_field == law.held_field);
}

namespace {

/// A fluid of the user's own, with one line of its file in place of another.
std::string own_fluid(const std::string& line = {}, const std::string& other = {}) {
  std::string text =
      "name: mine\nsource: a rheometer\ndensity: 3000 kg/m^3\n"
      "viscosity: [[20 degC, 0.2 Pa*s], [40 degC, 0.1 Pa*s]]\n"
      "herschel_bulkley: {index: 0.8, shear_rate: 1000 1/s}\n"
      "laws:\n  measured:\n    field: {points: [[0, 0], [100 kA/m, 0.4 T], [300 kA/m, 0.9 T]]}\n"
      "    yield_stress: {points: [[0, 200 Pa], [100 kA/m, 20 kPa], [200 kA/m, 35 kPa]]}\n"
      "uncertainty: {yield_stress: 8 %, viscosity: 15 %}\n";
  if (const std::size_t at = text.find(line); !line.empty()) text.replace(at, line.size(), other);
  return text;
}
Fluid fluid_of(const std::string& text) { return read_fluid(parse_yaml(text, "mine.yaml")); }

}  // namespace

TEST_CASE("a fluid of one's own is read with its units, and written and read again to the bit") {
  const Fluid fluid = fluid_of(own_fluid());
  CHECK_CLOSE(fluid.viscosity(293.15), 0.2, 1e-12, 0);
  CHECK_CLOSE(fluid.viscosity(303.15), std::sqrt(0.02), 1e-12, 0);
  CHECK_CLOSE(fluid.viscosity(400), 0.1, 1e-12, 0);
  const FluidLaw& law = *fluid.law("");
  CHECK_CLOSE(law.yield_stress(50e3, 1), 10100, 1e-12, 0);
  CHECK(law.yield_stress(1e6, 1) == 35e3);
  CHECK_CLOSE(law.field(0.2), 50e3, 1e-12, 0);
  CHECK_CLOSE(law.field(0.9 + DASHPOT_MU0 * 1e5), 400e3, 1e-9, 0);

  const Fluid again = read_fluid(parse_yaml(format_json(to_json(fluid), false), "again"));
  CHECK(again.laws.front().yield_stresses == law.yield_stresses);
  CHECK(again.laws.front().flux_densities == law.flux_densities);
  CHECK(again.viscosities == fluid.viscosities);
  CHECK(again.index == 0.8);
  CHECK(again.yield_uncertainty == fluid.yield_uncertainty);
  for (const std::string& name : fluid_names())
    CHECK(format_json(to_json(read_fluid(to_json(*find_fluid(name))))) ==
          format_json(to_json(*find_fluid(name))));
}

TEST_CASE("a fluid that cannot be is refused with its line and what would be right") {
  const auto says = [](const std::string& line, const std::string& other, const char* words) {
    const std::string message = message_of([&] { fluid_of(own_fluid(line, other)); });
    CAPTURE(message);
    CHECK(message.find("mine.yaml:") == 0);
    CHECK(message.find(words) != std::string::npos);
  };
  says("20 kPa", "40 kPa", "the yield stress falls from 4e+04 to 3.5e+04");
  says("[200 kA/m, 35 kPa]", "[90 kA/m, 35 kPa]", "the points are out of order");
  says("0.4 T", "1 T", "the flux density falls");
  says("0.4 T", "0.9 T", "the flux density stays");
  says("{points: [[0, 0], [100 kA/m, 0.4 T], [300 kA/m, 0.9 T]]}", "{}", "one of volume_fraction");
  says("density:", "densitty:", "density");
  says("kPa]", "kN]", "not a unit of it");
  says("0.2 Pa*s", "-0.2 Pa*s", "viscosity is -0.2");
  says("8 %", "800 %", "a share");
  // Units that were forgotten.
  says("0.2 Pa*s", "200", "viscosity is 200 Pa*s");
  says("density: ", "density: 3 #", "density is 3 kg/m^3; 500 to 1e+04 kg/m^3, with its unit");
  says("[[0, 200 Pa], [100 kA/m, 20 kPa], [200 kA/m, 35 kPa]]",
       "[[0, 0.2], [100 kA/m, 20], [200 kA/m, 35]]", "greatest yield stress is 35 Pa");
  says("[[0, 200 Pa], [100 kA/m, 20 kPa], [200 kA/m, 35 kPa]]",
       "[[0, 0], [2e4, 1e5], [3.5e4, 2e5]]",
       "the yield stress is 2e+05 Pa at a field of 3.5e+04 A/m, which no MR fluid has");
  says("[20 degC, ", "[20, ", "temperature is 20 K");
  says("0.2 Pa*s", "0.02 Pa*s", "the viscosity rises from 0.02 to ");
  says("measured:", "My Law:", "names no law");
  says("{points: [[0, 200 Pa], [100 kA/m, 20 kPa], [200 kA/m, 35 kPa]]}",
       "{polynomial: [100, 0.3, -1e-6], up_to: 300 kA/m}", "the yield stress falls");
  says("{points: [[0, 200 Pa], [100 kA/m, 20 kPa], [200 kA/m, 35 kPa]]}",
       "{polynomial: [1 kPa, 1], up_to: 300 kA/m}",
       "is '1 kPa', not a number; coefficients without units: 1 to 4: tau = c0 + c1 H");
  says("laws:", "lawz:", "a fluid needs 'laws'; did you mean it by 'lawz'?");
}

TEST_CASE("an unknown fluid is named, with the known ones") {
  CHECK(message_of([] { find_fluid("140CH", "damper.yaml"); }).find("did you mean '140CG'") !=
        std::string::npos);
}
