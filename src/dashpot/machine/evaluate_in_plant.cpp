#include "dashpot/machine/evaluate_in_plant.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/machine/beyond_models.h"
#include "dashpot/machine/damper_drive.h"
#include "dashpot/machine/disagreeing_sensors.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/plant_cases.h"
#include "dashpot/machine/plant_residuals.h"
#include "dashpot/machine/plant_step.h"
#include "dashpot/machine/road_follower.h"
#include "dashpot/machine/sensor_doubts.h"

namespace dashpot {
namespace {

void require_free_run(const ObservedDampers& dampers, const InPlantSetup& setup) {
  require_setup(setup);
  require_known(setup);
  if (unmeasured_road(setup))
    throw Error("plant, road", "nothing measures it, so that nothing can be run free",
                "a channel with the road's height; 'dashpot observe' judges one sample ahead");
  for (const ObservedDamper& damper : dampers)
    if (damper.model->state_size() > kMostDamperStates)
      throw Error(damper.model->name(),
                  "has " + std::to_string(damper.model->state_size()) + " states",
                  "a plant takes " + std::to_string(kMostDamperStates));
}

/// The setup of which all of each recording is judged, each damper a kind of its own.
InPlantSetup as_judged(InPlantSetup setup) {
  setup.held_back = 0;
  if (const std::vector<std::string> struts = observer_names(setup).struts; struts.size() > 1) {
    setup.kinds = {.names = struts, .of = {}, .are_stated = true};
    for (std::size_t d = 0; d < struts.size(); ++d) setup.kinds.of.push_back(d);
  }
  return setup;
}

/// Where the plant is at the beginnings: those under which it comes nearest to the sensors.
std::vector<double> found_beginnings(const PlantResiduals& residuals,
                                     const PlantEvaluationOptions& options) {
  LeastSquaresOptions solver;
  solver.max_iterations = 30;
  solver.function_tolerance = 1e-6;
  solver.threads = options.threads;
  solver.on_iteration = [&](int, double, std::span<const double>) { options.monitor.check(); };
  const std::vector<double> rest = residuals.start({});
  if (rest.empty()) return rest;
  const LeastSquaresReport solved = solve(residuals.problem(0, options.threads), rest, solver);
  return std::isfinite(solved.cost) ? solved.x : rest;
}

DamperMotions motions_of(const std::vector<InPlantTrace>& traces, std::size_t dampers) {
  DamperMotions motions(dampers);
  for (std::size_t d = 0; d < dampers; ++d)
    for (const InPlantTrace& trace : traces) {
      const DamperTrace& own = trace.dampers[d];
      std::vector<DamperInput>& motion = motions[d].emplace_back();
      for (std::size_t k = trace.first; k < own.force.size(); ++k)
        motion.push_back({own.deflection[k], own.velocity[k], own.current[k]});
    }
  return motions;
}

}  // namespace

PlantEvaluation evaluate_in_plant(ObservedDampers dampers, const InPlantSetup& stated,
                                  const std::vector<PlantRecording>& as_recorded,
                                  const PlantEvaluationOptions& options) {
  constexpr std::size_t kFirstSteps = 4;
  require_free_run(dampers, stated);
  const InPlantSetup setup = as_judged(stated);
  assert(dampers.size() == setup.dampers());
  const std::vector<PlantRecording> recordings = with_followers(setup, as_recorded);
  for (std::size_t d = 0; d < dampers.size(); ++d)
    dampers[d].model = mounted(std::move(dampers[d].model),
                               drive_samples(setup.drive_of(d), recordings.front()).front());

  // What stands in each strut, and how large its motion is.
  std::vector<std::shared_ptr<const DamperModel>> held;
  for (const ObservedDamper& damper : dampers) held.push_back(damper.model);
  const ObserverScale size = observer_scale(dampers);
  const DataScale scale{
      .force = size.force, .stroke = size.stroke, .speed = size.speed, .drive = {}};

  // In finer steps until half of one hardly changes what is told.
  PlantEvaluation told;
  for (told.steps = options.steps > 0 ? options.steps : kFirstSteps;; told.steps *= 2) {
    options.monitor.report(std::to_string(told.steps) + " steps per sample",
                           static_cast<double>(told.steps) / (2 * kMostSteps));
    const PlantCases cases = make_cases(setup, recordings, told.steps, PlantMethod::StraightForce);
    const PlantResiduals residuals(setup, cases, held, {}, scale);
    const std::vector<double> x = found_beginnings(residuals, options);
    told.step_error = residuals.step_error(x, recordings, options.threads);
    if (told.step_error > kStepShare && options.steps == 0 && told.steps < kMostSteps) continue;
    residuals.describe(x, told.sensors, told.traces, options.threads);
    break;
  }

  // What speaks against it.
  constexpr double kMuch = 0.2;
  for (const SensorFigures& figure : told.sensors)
    if (!std::isfinite(figure.training))
      told.warnings.push_back(figure.recording + ": the plant diverges (" + figure.channel + ")");
  if (!told.warnings.empty()) return told;
  told.warnings = disagreeing_sensors(setup, told.traces);
  std::ranges::move(sensor_doubts(setup, told.sensors, told.traces),
                    std::back_inserter(told.warnings));
  if (told.step_error > kMuch)
    told.warnings.push_back("half the integrator's step changes a sensor by " +
                            format_number(100 * told.step_error, 2) + " % of its error");
  else
    std::ranges::move(beyond_models(dampers, setup, motions_of(told.traces, dampers.size())),
                      std::back_inserter(told.warnings));
  return told;
}

}  // namespace dashpot
