#include "dashpot/controller.h"
#include "dashpot/plant.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/dampers/passive_curve.h"
#include "dashpot/suspension/ground/earthquake.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/ground/road_profile.h"
#include "dashpot/suspension/plants/linear.h"
#include "dashpot/suspension/sweep/draw.h"
#include "dashpot/suspension/sweep/request_file.h"
#include "fuzz.h"

// Files and words of vehicles, roads and controllers.

namespace {

/// What is a plant has a row per coordinate everywhere, and a natural motion.
void plant_set_json(const std::string& input) {
  const dashpot::Plant plant = dashpot::parse_plant_set(input, "fuzz.json", "fuzz").plant;
  const std::size_t n = plant.size();
  require_true(n > 0 && plant.mass.size() == n * n && plant.stiffness.size() == n * n);
  for (const dashpot::Tyre& tyre : plant.tyres) require_true(tyre.row.size() == n);
  for (const dashpot::Strut& strut : plant.struts) require_true(strut.row.size() == n);
  (void)dashpot::natural_frequencies(dashpot::linear_plant(plant));
}

/// A tyre on any ground has a height at any time.
void require_ground(const dashpot::GroundMotion& ground) {
  for (const double t : {0.0, 0.01, 3.0, 1e6})
    for (const std::size_t track : {0, 1})
      require_true(std::isfinite(ground.foot(t, track, 2.5).height) &&
                   std::isfinite(ground.acceleration(t)));
  (void)ground.jumps(2.5);
}

void road_file(const std::string& input) {
  require_ground(
      *dashpot::drive_over(dashpot::load_road(fuzz_file("road.csv", input), "m", "mm"), 20));
}

void earthquake_file(const std::string& input) {
  require_ground(*dashpot::load_earthquake(fuzz_file("quake.csv", input), "g0"));
}

void curve_file(const std::string& input) {
  const dashpot::PassiveCurve curve =
      dashpot::load_passive_curve(fuzz_file("curve.csv", input).string());
  for (const double velocity : {curve.velocity_min(), curve.velocity_max(), 0.0})
    require_true(std::isfinite(curve.force({0, velocity, 0}, {})));
}

void ground_words(const std::string& input) {
  if (!names_a_device(input)) require_ground(*dashpot::make_ground(input, 1));
}

void controller_words(const std::string& input) {
  static const dashpot::PlantSet set = dashpot::load_plant_set("savaresi_spelta");
  const dashpot::ControlLimits limits;
  const dashpot::ControllerPointer controller =
      dashpot::make_controller(input, {limits, set.plant});
  (void)dashpot::needs_plant_state(input);
  std::vector<double> state(controller->state_size());
  controller->reset(state);
  const std::vector<double> plant_state(2 * set.plant.size(), 0.01);
  const std::vector<dashpot::StrutSignals> struts(set.plant.struts.size(),
                                                  {0.1, -1, 0.2, 0.01, -0.1, 100, 0.5});
  std::vector<dashpot::DamperDemand> demands(struts.size());
  for (int k = 0; k < 3; ++k) controller->step(struts, plant_state, state, demands);
}

void damper_words(const std::string& input) {
  if (names_a_device(input)) return;
  const dashpot::ChosenDamper damper = dashpot::choose_damper(input);
  std::vector<double> state(damper.model->state_size());
  damper.model->rest({}, state);
  (void)damper.model->force({0.01, 0.1, damper.drive_max}, state);
}

/// What is understood can be drawn.
void sweep_yaml(const std::string& input) {
  if (names_a_device(input)) return;
  const dashpot::SweepRequest request = dashpot::parse_sweep(input, "fuzz.yaml", "nowhere");
  const dashpot::SweepDraw draw = dashpot::draw_vehicle(request, 0);
  require_true(draw.values.size() == request.inputs.size());
  for (std::size_t k = 0; k < request.controllers.size(); ++k)
    (void)dashpot::vehicle_words(request, k, draw);
  (void)dashpot::road_words(request, draw);
}

const FuzzTarget targets[] = {
    {"plant_set_json", plant_set_json},   {"road_file", road_file},
    {"earthquake_file", earthquake_file}, {"curve_file", curve_file},
    {"ground_words", ground_words},       {"controller_words", controller_words},
    {"damper_words", damper_words},       {"sweep_yaml", sweep_yaml}};

}  // namespace
