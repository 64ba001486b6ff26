#include "dashpot/identify/fit/law_unknowns.h"

#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

DataScale example_scale(std::size_t levels) {
  DataScale scale{.force = 1000, .stroke = 0.02, .speed = 0.1};
  scale.drive = {.low = 0.5, .high = 2, .varies = false, .levels = levels};
  return scale;
}

double value_at(const LawModel& model, const char* parameter, double current) {
  std::vector<double> p(model.law().params.size());
  model.parameters_at(current, p.data());
  return p[model.law().index_of(parameter)];
}

}  // namespace

TEST_CASE("units give the size of a quantity in the data") {
  const DataScale scale = example_scale(3);
  CHECK_CLOSE(scale.of_unit("N"), 1000, 1e-14, 0);
  CHECK_CLOSE(scale.of_unit("m"), 0.02, 1e-14, 0);
  CHECK_CLOSE(scale.of_unit("m/s"), 0.1, 1e-14, 0);
  CHECK_CLOSE(scale.of_unit("N*s/m"), 1e4, 1e-14, 0);
  CHECK_CLOSE(scale.of_unit("N/m"), 5e4, 1e-14, 0);
  CHECK_CLOSE(scale.of_unit("s/m"), 10, 1e-14, 0);
  CHECK_CLOSE(scale.of_unit("1/m^2"), 2500, 1e-14, 0);
  CHECK(scale.of_unit("1") == 1);
}

TEST_CASE("unknowns are values of the parameters across the currents of the data") {
  const Law& law = find_law("bingham");
  const LawUnknowns unknowns(law, example_scale(3), DriveUnit::Ampere, OffsetMode::Record);
  // c0 linear: two, f_c quadratic: three; f0 is the nuisance offset, v_s is fixed
  REQUIRE(unknowns.size() == 5);
  const LawModel start = unknowns.model(unknowns.start());
  std::vector<double> moved = unknowns.start();
  moved[3] *= 2;  // f_c in the middle, at 1.25 A
  const LawModel model = unknowns.model(moved);
  CHECK_CLOSE(value_at(model, "f_c", 0.5), value_at(start, "f_c", 0.5), 1e-12, 0);
  CHECK_CLOSE(value_at(model, "f_c", 1.25), 2 * value_at(start, "f_c", 1.25), 1e-12, 0);
  CHECK_CLOSE(value_at(model, "f_c", 2), value_at(start, "f_c", 2), 1e-12, 0);
  CHECK(value_at(model, "f0", 1) == 0);
}

TEST_CASE("coefficients are linear in the unknowns, with the weights that they state") {
  const LawUnknowns unknowns(find_law("bingham"), example_scale(3), DriveUnit::Volt,
                             OffsetMode::None);
  std::vector<double> u = unknowns.start();
  for (std::size_t k = 0; k < u.size(); ++k) u[k] += 0.1 * static_cast<double>(k);
  for (const auto& c : unknowns.coefficients(u)) {
    if (c.weights.empty()) continue;
    double sum = 0;
    for (std::size_t k = 0; k < c.weights.size(); ++k) sum += c.weights[k] * u[c.first + k];
    CHECK_CLOSE(c.value, sum, 1e-12, 1e-12);
  }
  CHECK(unknowns.coefficients(u)[1].name == "c0_b");
  CHECK(unknowns.coefficients(u)[1].unit == "N*s/(m*V)");
}

TEST_CASE("fewer currents, simpler dependence; a varying drive adds the lag") {
  CHECK(LawUnknowns(find_law("bingham"), example_scale(2), DriveUnit::Ampere, OffsetMode::Record)
            .size() == 4);
  CHECK(LawUnknowns(find_law("bingham"), example_scale(1), DriveUnit::Ampere, OffsetMode::Record)
            .size() == 2);
  DataScale varying = example_scale(0);
  varying.drive.varies = true;
  const LawUnknowns unknowns(find_law("bingham"), varying, DriveUnit::Ampere, OffsetMode::Record);
  CHECK(unknowns.size() == 6);
  CHECK(unknowns.coefficients(unknowns.start()).back().name == "lag_rate");
}

TEST_CASE("every law starts inside its bounds, whatever the size of the damper") {
  for (const Law* law : laws())
    for (const double force : {20.0, 3000.0, 200000.0}) {
      DataScale scale = example_scale(3);
      scale.force = force;
      const LawUnknowns unknowns(*law, scale, DriveUnit::Ampere, OffsetMode::Record);
      Random random(1);
      for (const std::vector<double>& start : {unknowns.start(), unknowns.start(&random)})
        for (std::size_t k = 0; k < start.size(); ++k) {
          CHECK(start[k] >= unknowns.lower()[k]);
          CHECK(start[k] <= unknowns.upper()[k]);
        }
    }
}

TEST_CASE("a drive that varies little tells as little as one level, and the fit says so") {
  DataScale scale = example_scale(0);
  scale.drive = {.low = 1.12, .high = 1.21, .varies = true, .levels = 0};
  const LawUnknowns narrow(find_law("bingham"), scale, DriveUnit::Volt, OffsetMode::Record);
  CHECK(narrow.size() == 3);  // c0, f_c, the lag
  REQUIRE(narrow.warnings().size() == 1);
  CHECK(narrow.warnings()[0] ==
        "the drive goes from 1.12 to 1.21 V only: the force is taken to follow it not at all");

  scale.drive.low = 1;
  const LawUnknowns wider(find_law("bingham"), scale, DriveUnit::Volt, OffsetMode::Record);
  CHECK(wider.size() == 5);
  CHECK(contains(wider.warnings()[0], "by a straight line at most"));

  scale.drive.low = 0;
  CHECK(LawUnknowns(find_law("bingham"), scale, DriveUnit::Volt, OffsetMode::Record)
            .warnings()
            .empty());
}

TEST_CASE("flattened: each parameter that follows the drive, at all drives as at the greatest") {
  const LawUnknowns unknowns(find_law("bingham"), example_scale(3), DriveUnit::Ampere,
                             OffsetMode::Record);
  std::vector<double> u = unknowns.start();
  for (std::size_t k = 0; k < u.size(); ++k) u[k] += 0.1 * static_cast<double>(k);
  const LawModel before = unknowns.model(u);
  const auto flattened = unknowns.flattened(u);
  REQUIRE(flattened.size() == 2);  // c0 and f_c
  for (std::size_t k = 0; k < 2; ++k) {
    const char *flat = k == 0 ? "c0" : "f_c", *other = k == 0 ? "f_c" : "c0";
    const LawModel model = unknowns.model(flattened[k].unknowns);
    for (const double current : {0.5, 1.25, 2.0}) {
      CHECK_CLOSE(value_at(model, flat, current), value_at(before, flat, 2), 1e-12, 0);
      CHECK_CLOSE(value_at(model, other, current), value_at(before, other, current), 1e-12, 0);
    }
    CHECK(unknowns.groups()[k].first == flattened[k].group.first);
  }
}
