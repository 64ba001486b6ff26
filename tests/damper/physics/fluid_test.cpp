#include "dashpot/damper/physics/fluid.h"

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
    const double phi = find_fluid(row.fluid).volume_fraction;
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
    const FamilyFluid* table = find_fluid(row.fluid).family;
    CHECK_CLOSE(family_field(table, row.flux_density), row.field, 4e-8, 0);
    CHECK_CLOSE(family_field(table, -row.flux_density), -row.field, 4e-8, 0);
    CHECK_CLOSE(family_yield_stress(table, row.field), row.stress, 6e-8, 0);
  }
  const Fluid& fluid = find_fluid("140CG");
  for (const double field : {218.759e3, 470.329e3, 1000e3})
    CHECK_CLOSE(family_yield_stress(fluid.family, field), 59456.1, 1e-6, 0);
  CHECK(family_warnings(fluid, 200e3).size() == 1);
  CHECK(family_warnings(fluid, 300e3).at(1) ==
        "the yield stress of 140CG is held at 59.46 kPa above 218.8 kA/m, where the polynomial of "
        "the paper "
        "falls");
  CHECK(family_warnings(find_fluid("122EG"), 100e3).at(0).find("factor of 2 to 2.7") !=
        std::string::npos);
  CHECK(family_warnings(find_fluid("132DG"), 1e6).empty());
}

TEST_CASE("the polynomial of 122EG turns where it is held; its measured points rise and are held") {
  const FamilyFluid& table = *find_fluid("122EG").family;
  const double top = table.held_field;
  CHECK(family_yield_stress(&table, 0.99 * top) < family_yield_stress(&table, top));
  CHECK_CLOSE(table.yield[1] + top * (2 * table.yield[2] + top * 3 * table.yield[3]), 0, 0, 1e-4);
  CHECK(measured_yield_stress_122eg(0) == 779.93);
  CHECK_CLOSE(measured_yield_stress_122eg(102.83e3), 21101.58, 1e-12, 0);
  CHECK_CLOSE(measured_yield_stress_122eg(145.63e3), (21101.58 + 30174.10) / 2, 1e-12, 0);
  CHECK(measured_yield_stress_122eg(1e6) == 33500);
}

TEST_CASE("an unknown fluid is named, with the known ones") {
  CHECK(message_of([] { find_fluid("140CH", "damper.yaml"); }).find("did you mean '140CG'") !=
        std::string::npos);
}
