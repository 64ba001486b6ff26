#include "dashpot/machine/in_plant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "dashpot/base/parallel.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/plant_advice.h"
#include "dashpot/machine/plant_residuals.h"
#include "dashpot/machine/plant_start.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/machine/without_road.h"

namespace dashpot {
namespace {

constexpr std::size_t kMostSteps = 16;  // of the integrator per sample, unasked

LeastSquaresOptions solver_options(const InPlantOptions& options, int iterations,
                                   double tolerance) {
  LeastSquaresOptions solver;
  solver.max_iterations = iterations;
  solver.function_tolerance = tolerance;
  solver.threads = options.threads;
  solver.on_iteration = [&options](int, double, std::span<const double>) {
    options.monitor.check();
  };
  return solver;
}

/// The law's unknowns in some size of its force, and where their fit has come to.
struct Candidate {
  LawUnknowns unknowns;
  std::vector<double> x;
  double cost = INFINITY;
};

/// Starts that differ in how much of the force is the damper's, and in how soon it bends: neither
/// is known beforehand. Behind the first of them the rest is at random.
std::vector<Candidate> candidates(const Law& law, const InPlantSetup& setup,
                                  const PlantCases& cases, const PlantStart& start,
                                  const InPlantOptions& options) {
  constexpr struct {
    double force, stroke;
  } kSizes[] = {{1, 1}, {0.3, 1}, {1, 10}, {0.3, 10}, {3, 30}, {0.1, 1}};
  std::vector<Candidate> all;
  Random random(options.seed);
  for (std::size_t k = 0; k < static_cast<std::size_t>(options.starts); ++k) {
    const auto [force, stroke] = kSizes[k % std::size(kSizes)];
    DataScale scale = start.scale;
    scale.force *= force;
    scale.stroke *= stroke;
    scale.speed *= stroke;
    all.push_back({{law, scale, setup.drive_unit, OffsetMode::Record, options.choices}, {}});
    const PlantResiduals residuals(setup, cases, all.back().unknowns, start.plant, start.scale);
    all.back().x =
        residuals.start(start.plant, start.states, k >= std::size(kSizes) ? &random : nullptr);
  }
  return all;
}

/// The most promising of them: all are fitted over a short time, where errors in the parameters
/// have not yet driven the motions apart, the better half over a longer one, and so on.
Candidate best_start(const Law& law, const InPlantSetup& setup, const PlantCases& cases,
                     const PlantStart& start, const InPlantOptions& options) {
  constexpr int kIterations = 25;
  constexpr double kTolerance = 1e-4, kFirstRadius = 10;
  constexpr std::size_t kHorizons[] = {250, 700, 2500};
  std::vector<Candidate> left = candidates(law, setup, cases, start, options);
  double done = 0;
  for (const std::size_t horizon : kHorizons) {
    options.monitor.report("starts, over " + std::to_string(horizon) + " samples", done);
    done += 0.1;
    parallel_for(left.size(), options.threads, [&](std::size_t k) {
      Candidate& one = left[k];
      const PlantResiduals residuals(setup, cases, one.unknowns, start.plant, start.scale);

      // A delay waits for the fit of all.
      LeastSquaresProblem trial = residuals.problem(horizon, 1);
      for (std::size_t d = residuals.first_delay(); d < one.x.size(); ++d)
        trial.lower[d] = trial.upper[d] = one.x[d];
      LeastSquaresOptions solver = solver_options(options, kIterations, kTolerance);
      solver.first_radius = kFirstRadius;
      const LeastSquaresReport solved = solve(trial, residuals.off_bounds(one.x), solver);
      one.cost = solved.cost;
      if (std::isfinite(solved.cost)) one.x = solved.x;
    });
    std::ranges::stable_sort(left, {}, &Candidate::cost);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>((left.size() + 1) / 2), left.end());
  }
  return left.front();
}

/// So many steps per sample that the method, whose limit is 2.78, stays stable with the law as it
/// starts.
std::size_t stable_steps(const Law& law, const InPlantSetup& setup, const PlantCases& cases,
                         const PlantStart& start, const InPlantOptions& options) {
  constexpr double kStable = 2;  // fastest rate times step
  if (!law.rate) return cases.steps;
  const LawUnknowns unknowns(law, start.scale, setup.drive_unit, OffsetMode::Record,
                             options.choices);
  std::vector<double> parameters(law.params.size());
  unknowns.model(unknowns.start()).parameters_at(start.scale.drive.high, parameters.data());
  const double rate = law.rate(parameters.data(), start.scale.speed);
  std::size_t steps = cases.steps;
  const double sample_time = cases.all.front().driving.sample_time;
  while (steps < kMostSteps && rate * sample_time > kStable * static_cast<double>(steps))
    steps *= 2;
  return steps;
}

/// Numbers whose profile is wanted must be among those that are fitted.
void require_profiles(const Law& law, const InPlantSetup& setup, const DataScale& scale,
                      const InPlantOptions& options) {
  if (options.profiles.empty()) return;
  std::vector<std::string> known;
  for (const PlantUnknown& unknown : setup.unknown) known.push_back(unknown.name);
  const LawUnknowns unknowns(law, scale, setup.drive_unit, OffsetMode::Record, options.choices);
  for (const auto& c : unknowns.coefficients(unknowns.start()))
    if (c.weights.size() == 1) known.push_back(c.name);
  for (const std::string& name : options.profiles)
    if (std::ranges::find(known, name) == known.end())
      throw Error("profile", "'" + name + "' is no number that is fitted by itself",
                  suggest(name, known));
}

/// Numbers whose local interval is not to be believed, a few, and those whose profile is wanted.
std::vector<std::string> profiled(const InPlantReport& report, const InPlantOptions& options) {
  constexpr std::size_t kMost = 3;
  std::vector<std::string> names = options.profiles;
  for (const auto* list : {&report.plant, &report.damper})
    for (const FittedParameter& p : *list)
      if (p.weak && !p.fixed && names.size() < options.profiles.size() + kMost &&
          std::ranges::find(names, p.name) == names.end())
        names.push_back(p.name);
  return names;
}

/// Solves with each sensor's scale, takes the rms that is left as the new one, and solves again
/// until the scales stay. A single sensor needs no second round.
LeastSquaresReport solve_weighed(PlantResiduals& residuals, std::vector<double> x,
                                 const InPlantOptions& options) {
  constexpr int kRounds = 4;
  constexpr double kSame = 0.03, kTolerance = 1e-7;
  LeastSquaresReport solved;
  for (int round = 0; round < kRounds; ++round) {
    options.monitor.report("fit, round " + std::to_string(round + 1), 0.4 + 0.1 * round);
    solved = solve(residuals.problem(0, options.threads), std::move(x),
                   solver_options(options, options.iterations, kTolerance));
    if (!std::isfinite(solved.cost) || residuals.reweigh(solved.x) <= kSame) break;
    x = solved.x;
  }
  return solved;
}

}  // namespace

InPlantReport identify_in_plant(const Law& law, const InPlantSetup& setup,
                                const std::vector<PlantRecording>& recordings,
                                const InPlantOptions& options) {
  const double started = cpu_seconds();
  require_setup(setup);
  if (has_unmeasured_road(setup)) return identify_without_road(law, setup, recordings, options);
  InPlantReport report;

  // Where the plant's numbers start, and how large the damper's motion and force are: from a fit
  // with a spring and a dashpot in the damper's place.
  PlantCases cases = make_cases(setup, recordings, options.steps);
  double low = INFINITY, high = -INFINITY;
  for (const PlantCase& one : cases.all) {
    const auto [least, greatest] = std::ranges::minmax(one.driving.current);
    low = std::min(low, least);
    high = std::max(high, greatest);
  }
  require_drive(law, setup, low, high, options, report.warnings);
  const PlantStart start = plant_start(setup, recordings, cases, options);
  report.warnings.insert(report.warnings.end(), start.warnings.begin(), start.warnings.end());

  require_profiles(law, setup, start.scale, options);

  // The law's unknowns in the size of these data, and a start from which the fit gets on.
  if (options.steps == 0)
    cases = make_cases(setup, recordings, stable_steps(law, setup, cases, start, options));
  Candidate best = best_start(law, setup, cases, start, options);
  while (!std::isfinite(best.cost) && options.steps == 0 && cases.steps < kMostSteps) {
    cases = make_cases(setup, recordings, 2 * cases.steps);
    best = best_start(law, setup, cases, start, options);
  }
  const auto& [unknowns, x, cost] = best;
  for (const std::string& warning : unknowns.warnings()) report.warnings.push_back(warning);
  PlantResiduals residuals(setup, cases, unknowns, start.plant, start.scale);

  // What can be told is said before the fit.
  const LeastSquaresReport at =
      solve(residuals.problem(0, options.threads), x, solver_options(options, 0, 1e-8));
  report.knowable = knowable_of(residuals, at.part_matrices, x.size());

  // The fit; where the integrator's step is too long for its error, once more with half of it.
  constexpr double kStepShare = 0.05;
  LeastSquaresReport solved = solve_weighed(residuals, x, options);
  report.iterations = solved.iterations;
  while (std::isfinite(solved.cost)) {
    report.step_error = residuals.step_error(solved.x, recordings);
    if (options.steps > 0 || report.step_error <= kStepShare || cases.steps >= kMostSteps) break;
    cases = make_cases(setup, recordings, 2 * cases.steps);
    solved = solve_weighed(residuals, solved.x, options);
    report.iterations += solved.iterations;
  }
  if (report.step_error > kStepShare)
    report.warnings.push_back("the integrator's step changes a sensor by " +
                              format_number(100 * report.step_error, 2) +
                              " % of its error: the law is too sharp for it");
  report.steps = cases.steps;
  report.message = solved.message;
  report.seconds = cpu_seconds() - started;
  if (solved.x.empty() || !std::isfinite(solved.cost)) {
    report.message = "the plant diverges wherever the fit begins: " + solved.message;
    return report;
  }
  report.status =
      solved.converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;

  // Intervals: correlated residuals count as one, and sensors differ.
  const Covariance spread = residuals.covariance_at(solved);
  add_parameters(residuals, solved.x, spread, report);
  add_warnings(residuals, spread, report);

  // What would help, and how far doubtful numbers may lie.
  const EndedFit ended{setup, cases, unknowns, residuals, solved, start.plant, start.scale};
  if (!options.grade.empty())
    report.advice = advise(ended, find_sensor_grade(options.grade, "grade"), options);
  report.advice.profiles = profiles_of(ended, spread, profiled(report, options), options);

  // The whole of each recording in free run, with the end that was held back.
  report.model = std::make_shared<LawModel>(residuals.damper(solved.x));
  residuals.describe(solved.x, report.sensors, report.traces);
  for (const SensorFigures& figure : report.sensors)
    if (std::isinf(figure.held_back))
      report.warnings.push_back(figure.recording + ": the plant diverges on the time held back (" +
                                figure.channel + ")");
  report.domain = {
      INFINITY, -INFINITY, INFINITY, -INFINITY, start.scale.drive.low, start.scale.drive.high};
  for (const InPlantTrace& trace : report.traces) {
    const auto [shortest, longest] = std::ranges::minmax(trace.deflection);
    const auto [slowest, quickest] = std::ranges::minmax(trace.velocity);
    report.domain.displacement_min = std::min(report.domain.displacement_min, shortest);
    report.domain.displacement_max = std::max(report.domain.displacement_max, longest);
    report.domain.velocity_min = std::min(report.domain.velocity_min, slowest);
    report.domain.velocity_max = std::max(report.domain.velocity_max, quickest);
  }
  report.seconds = cpu_seconds() - started;
  return report;
}

std::vector<double> plant_response(const Plant& plant, const DamperModel& damper,
                                   const InPlantSetup& setup, const PlantRecording& recording,
                                   std::size_t steps) {
  std::vector<PlantInputPlace> inputs;
  for (const PlantInputChannel& input : setup.inputs) inputs.push_back(input.place);
  const DrivenPlant equations(plant, setup.strut, inputs);
  const PlantCases cases = make_cases(setup, {recording}, steps);
  const PlantDriving& driving = cases.all.front().driving;

  std::vector<double> state(2 * plant.size() + damper.state_size());
  damper.rest({0, 0, driving.current.front()}, std::span(state).subspan(2 * plant.size()));
  std::vector<std::vector<double>> shown;
  if (!equations.run(damper, driving, driving.samples, {&setup.sensors.front().place, 1}, state,
                     shown))
    throw Error(recording.name, "the plant diverges with this damper");
  return shown.front();
}

}  // namespace dashpot
