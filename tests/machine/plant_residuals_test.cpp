#include "dashpot/machine/plant_residuals.h"

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "dashpot/base/random.h"
#include "dashpot/damper/law_list.h"

using namespace dashpot;

namespace {

/// A car on a rough road, with sensors of which the residuals are no matter.
PlantRecording rough_road(std::uint64_t seed, bool is_switched, double level) {
  constexpr std::size_t kSamples = 1500;
  PlantRecording recording{.name = "ride", .sample_time = 0.002, .samples = kSamples};
  Random random(seed);
  double road = 0;
  std::vector<double> heights, currents, shown;
  for (std::size_t k = 0; k < kSamples; ++k) {
    road += 0.05 * (0.03 * random.normal() - road);
    heights.push_back(road);
    currents.push_back(is_switched ? std::floor(static_cast<double>(k) / 200) / 4 : level);
    shown.push_back(0.01 * random.normal());
  }
  recording.channels = {{"road", "m", heights},
                        {"coil", "A", currents},
                        {"body", "m/s^2", shown},
                        {"level", "m", shown}};
  return recording;
}

InPlantSetup car() {
  InPlantSetup setup;
  setup.model = &find_machine("quarter_car", "test");
  setup.known = {{"unsprung_mass", 40}, {"spring_stiffness", 20e3}};
  setup.unknown = {{"sprung_mass", 100, 1000, 350}, {"tyre_stiffness", 1e5, 1e6, 2e5}};
  setup.inputs = {{"road", {PlantInput::Ground, 0}}};
  setup.sensors = {{.channel = "body", .place = {PlantQuantity::Acceleration, 0}},
                   {.channel = "level", .place = {PlantQuantity::Deflection, 0}}};
  setup.sensors.back().finds_delay = true;
  setup.sensors.front().finds_cutoff = CutoffRange{};
  setup.drives = {{.channel = "coil"}};
  return setup;
}

double length_of(const std::vector<double>& a) {
  return std::sqrt(std::inner_product(a.begin(), a.end(), a.begin(), 0.0));
}

/// How far columns are from differences of the residuals; the furthest, of its length.
double worst_column(const LeastSquaresProblem& problem, const std::vector<double>& x) {
  constexpr double kStep = 1e-5, kFelt = 1e-4;
  std::vector<double> r(problem.residuals);
  std::vector<std::vector<double>> columns(x.size(), r);
  std::vector<double*> places;
  for (std::vector<double>& column : columns) places.push_back(column.data());
  REQUIRE(problem.jacobian(x, r, places));
  double worst = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    std::vector<double> moved = x, above = r, below = r;
    const double step = kStep * std::max(1.0, std::abs(x[k]));
    moved[k] = x[k] + step;
    REQUIRE(problem.residual(moved, above));
    moved[k] = x[k] - step;
    REQUIRE(problem.residual(moved, below));
    for (std::size_t i = 0; i < r.size(); ++i) above[i] = (above[i] - below[i]) / (2 * step);
    for (std::size_t i = 0; i < r.size(); ++i) below[i] = above[i] - columns[k][i];
    const double apart = length_of(below) / std::max(length_of(above), kFelt * length_of(r));
    INFO("unknown ", k, ": ", apart);
    worst = std::max(worst, apart);
  }
  return worst;
}

}  // namespace

TEST_CASE("plant residuals: columns are the differences of runs, however they are made") {
  // At steady currents a parameter's unknowns act as one; a switched one tells them apart.
  constexpr double kClose = 0.03;  // two of the laws have kinks
  const InPlantSetup setup = car();
  const std::vector<PlantRecording> recordings = {rough_road(1, false, 0), rough_road(2, false, 1),
                                                  rough_road(3, true, 0)};
  for (const std::string law :
       {"tanh_guo", "hysteretic_biviscous", "bouc_wen", "modified_bouc_wen", "tanh_kwok"}) {
    const Law& tried = find_law(law);
    INFO(law);
    for (const PlantMethod method : {PlantMethod::RungeKutta, PlantMethod::StraightForce}) {
      if (method == PlantMethod::StraightForce && !tried.step) continue;
      const PlantCases cases = make_cases(setup, recordings, 4, method);
      DataScale scale{.force = 1000, .stroke = 0.02, .speed = 0.3, .drive = {0, 1, true, 1}};
      const DamperUnknowns unknowns({tried, scale, setup.drive_unit, OffsetMode::Record},
                                    setup.kinds);
      const PlantResiduals residuals(setup, cases, unknowns, {350, 2e5}, scale);
      const std::vector<double> states{0.01, 0.002, -0.1, 0.05, 0,   0.001,
                                       0.1,  0.2,   0,    0.01, 0.3, -0.1};
      std::vector<double> x = residuals.start({350, 2e5}, states);
      x[residuals.first_of_sensors()] = 0.7;      // samples late
      x[residuals.first_of_sensors() + 1] = 1.5;  // samples: a cut-off of a tenth of their rate
      CHECK(worst_column(residuals.problem(), x) < kClose);
    }
  }
}

TEST_CASE(
    "plant residuals: columns of dampers of two kinds, one of which is another than the other") {
  constexpr double kClose = 0.03;
  InPlantSetup setup = car();
  setup.model = &find_machine("half_car", "test");
  setup.known = {};
  setup.unknown = {{"mass", 100, 1000, 600}};
  setup.inputs = {{"road", {PlantInput::Ground, 0, 0}}, {"level", {PlantInput::Ground, 0, 1}}};
  setup.sensors = {{.channel = "body", .place = {PlantQuantity::Acceleration, 0}}};
  setup.kinds = {.names = {"front", "rear"}, .of = {0, 1}};
  setup.from_rest = true;
  const std::vector<PlantRecording> recordings = {rough_road(1, false, 1), rough_road(3, true, 0)};
  for (const std::string law : {"tanh_guo", "modified_bouc_wen"}) {
    INFO(law);
    const Law& tried = find_law(law);
    const PlantCases cases = make_cases(
        setup, recordings, 4, tried.step ? PlantMethod::StraightForce : PlantMethod::RungeKutta);
    DataScale scale{.force = 1000, .stroke = 0.02, .speed = 0.3, .drive = {0, 1, true, 1}};
    const DamperUnknowns unknowns({tried, scale, setup.drive_unit, OffsetMode::Record},
                                  setup.kinds);
    const PlantResiduals residuals(setup, cases, unknowns, {600}, scale);
    std::vector<double> x = residuals.start({600});
    for (std::size_t k = 0; k < x.size(); ++k)
      if (residuals.is_of_law(k)) x[k] *= 1 + 0.01 * static_cast<double>(k);
    CHECK(worst_column(residuals.problem(), x) < kClose);
  }
}
