#include "dashpot/report/simulation_document.h"

#include "dashpot/suspension/ground/ground_sequences.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A building of two storeys that a pulse of the ground shakes, without a damper; against it the
/// same one with a damper, where asked for.
Simulation shaken_building(bool is_compared) {
  const TemporaryFolder folder;
  const std::filesystem::path file =
      folder.write("pulse.csv", "time [s],a [m/s^2]\n0,0\n0.1,2\n0.2,-2\n0.3,0\n");
  const GroundPointer ground = make_ground("earthquake,file=" + file.string(), 1);
  const auto run_with = [&](const std::string& damper) {
    return run_vehicle(std::make_shared<const Vehicle>(make_vehicle(
                           {.plant = "building", .values = {"storeys=2"}, .dampers = {damper}})),
                       *ground, {.duration = 2});
  };
  Simulation simulation{.run = run_with("viscous,damping=0"),
                        .ground = ground->description(),
                        .duration = 2,
                        .discard = 0};
  if (is_compared) simulation.against = run_with("viscous,damping=2000");
  return simulation;
}

double greatest(const std::vector<double>& values) {
  double top = 0;
  for (const double value : values) top = std::max(top, std::abs(value));
  return top;
}

}  // namespace

TEST_CASE("a building's verdict names the worst drift and acceleration, and against what") {
  const std::string alone = simulation_document(shaken_building(false)).verdict;
  CHECK(contains(alone, "Drift at most "));
  CHECK(contains(alone, "(floor_1); absolute acceleration at most "));
  CHECK(contains(alone, "(floor_2)."));
  const std::string compared = simulation_document(shaken_building(true)).verdict;
  CHECK(contains(compared, "Against viscous, 2000 N*s/m: drift at most "));
  CHECK(contains(compared, "% more"));
}

TEST_CASE("the acceleration of a floor is drawn as it is measured: with the ground's") {
  const Simulation simulation = shaken_building(false);
  const Document document = simulation_document(simulation);
  const FigurePanel& panel = document.sections.at(1).figures.front().panels.at(2);
  CHECK(panel.title == "floor_2, acceleration, absolute");
  CHECK_CLOSE(greatest(panel.series.front().y),
              measure_named(simulation.run.measures, "floor_2_acceleration"), 1e-12, 0);
}

TEST_CASE("each damper and each tyre of a car has a panel, and the ground under each tyre a line") {
  const GroundPointer ground = make_ground("bump", 1);
  const auto car = std::make_shared<const Vehicle>(
      make_vehicle({.plant = "half_car_a", .dampers = {"spencer1997"}, .current = 1}));
  const Document document =
      simulation_document({.run = run_vehicle(car, *ground, {.duration = 0.5}),
                           .ground = ground->description(),
                           .duration = 0.5,
                           .discard = 0});
  const std::vector<DocumentFigure>& figures = document.sections.at(1).figures;
  std::vector<std::string> titles;
  for (const FigurePanel& panel : figures.at(0).panels) titles.push_back(panel.title);
  CHECK(titles == std::vector<std::string>{"Ground", "body, acceleration", "front_tyre, load",
                                           "rear_tyre, load", "front, deflection",
                                           "rear, deflection", "front, damper force",
                                           "rear, damper force", "front, drive", "rear, drive"});
  REQUIRE(figures.at(0).panels.front().series.size() == 2);
  CHECK(figures.at(0).panels.front().series[1].label == "under rear_tyre");
  REQUIRE(figures.at(1).panels.size() == 2);
  CHECK(figures.at(1).panels[1].title == "rear");
}
