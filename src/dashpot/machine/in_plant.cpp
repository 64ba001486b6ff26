#include "dashpot/machine/in_plant.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include "dashpot/base/parallel.h"
#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/machine/bench_start.h"
#include "dashpot/machine/beside_noise.h"
#include "dashpot/machine/damper_drive.h"
#include "dashpot/machine/disagreeing_sensors.h"
#include "dashpot/machine/force_leap.h"
#include "dashpot/machine/found_noise.h"
#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/more_unknowns.h"
#include "dashpot/machine/plant_advice.h"
#include "dashpot/machine/plant_residuals.h"
#include "dashpot/machine/plant_start.h"
#include "dashpot/machine/recording_parts.h"
#include "dashpot/machine/road_delay.h"
#include "dashpot/machine/road_follower.h"
#include "dashpot/machine/sensor_doubts.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/machine/without_road.h"

namespace dashpot {
namespace {

/// Samples over which starts are compared, one after the other.
constexpr std::array<std::size_t, 3> kHorizons{250, 700, 2500};

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

/// The unknowns of the law in the dampers, in some size of force and motion.
DamperUnknowns unknowns_of(const Law& law, const DataScale& scale, const InPlantSetup& setup,
                           const InPlantOptions& options) {
  return {law, scale, setup, options.choices};
}

/// The law's unknowns in some size of its force, and where their fit has come to.
struct Candidate {
  DamperUnknowns unknowns;
  std::vector<double> x;
  double cost = INFINITY;
  std::optional<DamperUnknowns::Group> held = {};  ///< of the law, while all else is fitted
};

/// Forces are seen only through a plant of which something is expected.
bool is_expected(const InPlantSetup& setup) {
  constexpr double kWide = 100;
  return std::ranges::all_of(setup.unknown, [](const PlantUnknown& one) {
    return one.about || (one.lower > 0 && one.upper <= kWide * one.lower);
  });
}

/// The law as a bench would find it from the motion and force that the sensors tell without a law;
/// none where a filter cannot follow the plant, or no fit gets on.
std::optional<Candidate> bench_candidate(const Law& law, const InPlantSetup& setup,
                                         const std::vector<PlantRecording>& recordings,
                                         const PlantCases& cases, const PlantStart& start,
                                         const InPlantOptions& options) {
  options.monitor.report("the law, as on a bench", 0);
  InPlantOptions alike = options;
  alike.asymmetric = false;
  std::vector<PlantRecording> fitted = fitted_parts(setup, recordings);
  for (PlantRecording& one : fitted) one = part_of(one, 0, std::min(one.samples, kHorizons.back()));
  std::vector<Record> records;
  std::shared_ptr<const DamperModel> found;
  try {
    records =
        as_bench_records(setup, fitted, observe_without_law(setup, start.plant, fitted, alike));
    found = fit_as_on_bench(law, setup, records, alike);
  } catch (const Error&) {
    return {};  // a start among others: what is wrong with the recordings is said elsewhere
  }
  if (!found) return {};

  // Its numbers among all unknowns; plant and states as they start.
  const DataScale scale = data_scale(records, setup.drive_unit);
  Candidate one{unknowns_of(law, scale, setup, options), {}};
  const PlantResiduals residuals(setup, cases, one.unknowns, start.plant, start.scale);
  one.x = residuals.start(start.plant, start.states);
  std::ranges::copy(one.unknowns.off_bounds(one.unknowns.of({found->law_inside(), 1})),
                    one.x.begin() + static_cast<std::ptrdiff_t>(start.plant.size()));
  return one;
}

/// Starts that differ in how much of the force is the damper's, and in how soon it bends: neither
/// is known beforehand. Behind the first of them the rest is at random. A start from the bench
/// stands before them, and few others then beside it.
std::vector<Candidate> candidates(const Law& law, const InPlantSetup& setup,
                                  const PlantCases& cases, const PlantStart& start,
                                  const std::optional<Candidate>& from_bench,
                                  const InPlantOptions& options) {
  constexpr struct {
    double force, stroke;
  } kSizes[] = {{1, 1}, {0.3, 1}, {1, 10}, {0.3, 10}, {3, 30}, {0.1, 1}};
  constexpr int kFewer = 4;
  std::vector<Candidate> all;
  if (from_bench) all.push_back(*from_bench);

  // Each scales what a fit expects of the damper; those behind the sizes above start at random.
  const int others = from_bench ? options.starts / kFewer : options.starts;
  Random random(options.seed);
  for (std::size_t k = 0; k < static_cast<std::size_t>(others); ++k) {
    const auto [force, stroke] = kSizes[k % std::size(kSizes)];
    DataScale scale = start.scale;
    scale.force *= force;
    scale.stroke *= stroke;
    scale.speed *= stroke;
    all.push_back({unknowns_of(law, scale, setup, options), {}});
    const PlantResiduals residuals(setup, cases, all.back().unknowns, start.plant, start.scale);
    all.back().x =
        residuals.start(start.plant, start.states, k >= std::size(kSizes) ? &random : nullptr);
  }
  return all;
}

/// What starts are fitted in.
struct Trial {
  const InPlantSetup& setup;
  const PlantCases& cases;
  const PlantStart& start;
  const InPlantOptions& options;
};

/// Fits all over so many samples (0: all that there are), and puts the best first.
void fit_over(std::size_t horizon, const Trial& in, std::vector<Candidate>& all) {
  constexpr int kIterations = 25;
  constexpr double kTolerance = 1e-4, kFirstRadius = 10;
  parallel_for(all.size(), in.options.threads, [&](std::size_t k) {
    Candidate& one = all[k];
    const PlantResiduals residuals(in.setup, in.cases, one.unknowns, in.start.plant,
                                   in.start.scale);
    LeastSquaresProblem problem = residuals.problem(horizon, in.options.threads);
    const auto hold = [&](std::size_t place) {
      problem.lower[place] = problem.upper[place] = one.x[place];
    };

    // A delay waits for the fit of all; beside a filter that is not there a law may lose its
    // memory for good.
    for (std::size_t own = residuals.first_of_sensors(); own < one.x.size(); ++own)
      if (residuals.of_sensor(own)->of == SensorUnknown::Of::Delay) hold(own);
    for (std::size_t u = 0; one.held && u < one.held->count(); ++u)
      hold(in.start.plant.size() + one.held->first + u);
    LeastSquaresOptions solver = solver_options(in.options, kIterations, kTolerance);
    solver.first_radius = kFirstRadius;
    const LeastSquaresReport solved = solve(problem, residuals.off_bounds(one.x), solver);
    one.cost = solved.cost;
    if (std::isfinite(solved.cost)) one.x = solved.x;
  });
  std::ranges::stable_sort(all, {}, &Candidate::cost);
}

/// The best once more from where a parameter of its law does not follow the drive, first held
/// there: one that takes on another's part at a low drive may have been left so. Where that leaves
/// clearly less, of all too once both are fitted to that, it stands first.
void add_flattened(std::size_t horizon, const Trial& in, std::vector<Candidate>& all) {
  constexpr double kClearly = 0.9;
  constexpr std::size_t kAll = 0, kShorter = 3;
  const Candidate best = all.front();

  // One parameter after the other.
  const std::size_t first = in.start.plant.size();
  std::vector<Candidate> others;
  for (const DamperUnknowns::Flattened& flat :
       best.unknowns.flattened(std::span(best.x).subspan(first, best.unknowns.size()))) {
    others.push_back(best);
    others.back().held = flat.group;
    std::ranges::copy(flat.unknowns, others.back().x.begin() + static_cast<std::ptrdiff_t>(first));
  }
  if (others.empty()) return;

  // Held there over a part of the horizon, then free.
  fit_over(horizon / kShorter, in, others);
  for (Candidate& one : others) one.held = {};
  fit_over(horizon, in, others);
  if (!(others.front().cost < kClearly * best.cost)) return;

  // Both to all that there is.
  std::vector<Candidate> as_before{best}, other{std::move(others.front())};
  fit_over(kAll, in, as_before);
  fit_over(kAll, in, other);
  if (other.front().cost < kClearly * as_before.front().cost)
    all.insert(all.begin(), std::move(other.front()));
}

/// The most promising of them: all are fitted over a short time, where errors in the parameters
/// have not yet driven the motions apart, the better half over a longer one, and so on. Its cost is
/// infinite where the plant diverges later.
Candidate best_start(const Law& law, const InPlantSetup& setup, const PlantCases& cases,
                     const PlantStart& start, const std::optional<Candidate>& from_bench,
                     const InPlantOptions& options) {
  const Trial in{setup, cases, start, options};
  std::vector<Candidate> left = candidates(law, setup, cases, start, from_bench, options);
  double done = 0;
  for (const std::size_t horizon : kHorizons) {
    options.monitor.report("starts, over " + std::to_string(horizon) + " samples", done);
    done += 0.1;
    fit_over(horizon, in, left);
    if (horizon == kHorizons.back()) break;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>((left.size() + 1) / 2), left.end());
  }
  if (std::isfinite(left.front().cost)) add_flattened(kHorizons.back(), in, left);

  // The first that goes through all of the recordings.
  for (const Candidate& one : left) {
    const PlantResiduals residuals(setup, cases, one.unknowns, start.plant, start.scale);
    const LeastSquaresProblem whole = residuals.problem(0, options.threads);
    std::vector<double> r(whole.residuals);
    if (whole.residual(one.x, r)) return one;
  }
  left.front().cost = INFINITY;
  return left.front();
}

/// So many steps per sample that Runge-Kutta, whose limit is 2.78, stays stable with the law as it
/// starts.
std::size_t stable_steps(const Law& law, const InPlantSetup& setup, const PlantCases& cases,
                         const PlantStart& start, const InPlantOptions& options) {
  constexpr double kStable = 2;  // fastest rate times step
  if (!law.rate) return cases.steps;
  const DamperUnknowns unknowns = unknowns_of(law, start.scale, setup, options);
  std::vector<double> parameters(law.params.size());
  unknowns.models(unknowns.start())
      .front()
      .parameters_at(start.scale.drive.high, parameters.data());
  const double rate = law.rate(parameters.data(), start.scale.speed);
  std::size_t steps = cases.steps;
  const double sample_time = cases.all.front().driving.sample_time;
  while (steps < kMostSteps && rate * sample_time > kStable * static_cast<double>(steps))
    steps *= 2;
  return steps;
}

/// The recordings for a force that goes straight over a step: one step per sample to begin with.
PlantCases under_straight_force(const InPlantSetup& setup,
                                const std::vector<PlantRecording>& recordings,
                                const InPlantOptions& options) {
  return make_cases(setup, recordings, std::max<std::size_t>(1, options.steps),
                    PlantMethod::StraightForce);
}

/// The law's unknowns in the size of these data, and a start from which the fit gets on; `cases`
/// become those of the method and the steps that the law asks for.
Candidate start_of_law(const Law& law, const InPlantSetup& setup,
                       const std::vector<PlantRecording>& recordings, PlantCases& cases,
                       const PlantStart& start, const InPlantOptions& options) {
  // One with a step of its own may have a sharp knee. Among several dampers the start from a bench
  // led to the same place.
  const bool may_be_sharp = is_expected(setup) && law.step;
  const bool is_seen = is_expected(setup) && setup.dampers() == 1;
  std::optional<Candidate> from_bench;
  if (is_seen && (law.step || law.states.empty()))
    from_bench = bench_candidate(law, setup, recordings, cases, start, options);
  if (may_be_sharp)
    cases = under_straight_force(setup, recordings, options);
  else if (options.steps == 0)
    cases = make_cases(setup, recordings, stable_steps(law, setup, cases, start, options));

  Candidate best = best_start(law, setup, cases, start, from_bench, options);
  if (!std::isfinite(best.cost) && cases.method == PlantMethod::RungeKutta) {
    cases = under_straight_force(setup, recordings, options);
    best = best_start(law, setup, cases, start, from_bench, options);
  }
  return best;
}

/// The same where a recording begins quietly: found where all move as they do on the whole, since a
/// damper that hardly bends tells little, and brought to their beginnings.
Candidate start_in_motion(const Law& law, const InPlantSetup& setup,
                          const std::vector<PlantRecording>& recordings, PlantCases& cases,
                          const PlantStart& start, const InPlantOptions& options) {
  const std::vector<PlantRecording> lively = lively_parts(setup, recordings, kHorizons.back());
  if (lively.empty()) return start_of_law(law, setup, recordings, cases, start, options);

  // There, from states of their own.
  PlantCases shorter = make_cases(setup, lively, options.steps);
  PlantStart there = start;
  there.states = plant_start(setup, lively, shorter, options).states;
  Candidate best = start_of_law(law, setup, lively, shorter, there, options);
  cases = make_cases(setup, recordings, shorter.steps, shorter.method);

  // All but the states stays.
  const PlantResiduals residuals(setup, cases, best.unknowns, start.plant, start.scale);
  std::vector<double> x = residuals.start(start.plant, start.states);
  for (std::size_t k = 0; k < x.size(); ++k)
    if (k < residuals.first_state() || k >= residuals.first_of_sensors()) x[k] = best.x[k];
  best.x = std::move(x);
  return best;
}

/// Cut-offs are then looked for near those of the best start, so that less of each recording is
/// left out until filters have forgotten what was before it: behind much of that nothing tells
/// where the plant began. The recordings with that.
PlantCases cases_near(const Candidate& best, const PlantStart& start, const PlantCases& cases,
                      const std::vector<PlantRecording>& recordings, InPlantSetup& setup) {
  const PlantResiduals residuals(setup, cases, best.unknowns, start.plant, start.scale);
  const InPlantSetup found = residuals.setup_at(best.x);
  for (std::size_t s = 0; s < setup.sensors.size(); ++s)
    keep_cutoff_near(found.sensors[s].filter, recordings.front().sample_time, setup.sensors[s]);
  return make_cases(setup, recordings, cases.steps, cases.method);
}

/// Numbers whose profile is wanted must be among those that are fitted.
void require_profiles(const Law& law, const InPlantSetup& setup, const DataScale& scale,
                      const InPlantOptions& options) {
  if (options.profiles.empty()) return;
  std::vector<std::string> known;
  for (const PlantUnknown& unknown : setup.unknown) known.push_back(unknown.name);
  const DamperUnknowns unknowns = unknowns_of(law, scale, setup, options);
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
LeastSquaresReport solve_weighed(const InPlantSetup& setup, PlantResiduals& residuals,
                                 std::vector<double> x, const InPlantOptions& options) {
  constexpr int kRounds = 4;
  const bool goes_on = has_noisy_inputs(setup);  // from near by is then enough
  const double same = goes_on ? 0.1 : 0.03, tolerance = goes_on ? 1e-4 : 1e-7;
  LeastSquaresOptions solver = solver_options(options, options.iterations, tolerance);
  if (goes_on) solver.line_search = LineSearch::ByResiduals;
  LeastSquaresReport solved;
  for (int round = 0; round < kRounds; ++round) {
    options.monitor.report("fit, round " + std::to_string(round + 1), 0.4 + 0.1 * round);
    solved = solve(residuals.problem(0, options.threads), std::move(x), solver);
    if (!std::isfinite(solved.cost) || residuals.reweigh(solved.x) <= same) break;
    x = solved.x;
  }
  return solved;
}

/// What the dampers of a kind went through.
Domain domain_of(std::size_t kind, const InPlantSetup& setup,
                 const std::vector<InPlantTrace>& traces) {
  Domain domain{INFINITY, -INFINITY, INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (const InPlantTrace& trace : traces)
    for (std::size_t d = 0; d < trace.dampers.size(); ++d) {
      if (setup.kinds.at(d) != kind) continue;
      const DamperTrace& damper = trace.dampers[d];
      const auto [shortest, longest] = std::ranges::minmax(damper.deflection);
      const auto [slowest, quickest] = std::ranges::minmax(damper.velocity);
      const auto [least, greatest] = std::ranges::minmax(damper.current);
      domain.displacement_min = std::min(domain.displacement_min, shortest);
      domain.displacement_max = std::max(domain.displacement_max, longest);
      domain.velocity_min = std::min(domain.velocity_min, slowest);
      domain.velocity_max = std::max(domain.velocity_max, quickest);
      domain.current_min = std::min(domain.current_min, least);
      domain.current_max = std::max(domain.current_max, greatest);
    }
  return domain;
}

/// The fit; where the integrator's step is too long for its error, once more by the other method if
/// that is nearer, or in twice as many. `cases` are those of the residuals.
LeastSquaresReport solve_in_enough_steps(const InPlantSetup& setup,
                                         const std::vector<PlantRecording>& recordings,
                                         const InPlantOptions& options, PlantCases& cases,
                                         PlantResiduals& residuals, std::vector<double> x,
                                         InPlantReport& report) {
  // Weights and steps as the start, which is near by now, already asks for; a fit that goes on
  // beside the noise takes its steps there.
  const bool goes_on = has_noisy_inputs(setup);
  if (cases.method == PlantMethod::StraightForce) residuals.reweigh(x);
  while (!goes_on && cases.method == PlantMethod::StraightForce && options.steps == 0 &&
         cases.steps < kMostSteps &&
         residuals.step_error(x, recordings, options.threads) > kStepShare)
    cases = make_cases(setup, recordings, 2 * cases.steps, cases.method);

  for (;;) {
    LeastSquaresReport solved = solve_weighed(setup, residuals, x, options);
    report.iterations += solved.iterations;
    const bool is_finite = !solved.x.empty() && std::isfinite(solved.cost);
    if (is_finite) x = solved.x;
    if (is_finite && goes_on && cases.method == PlantMethod::StraightForce) return solved;
    report.step_error = is_finite ? residuals.step_error(x, recordings, options.threads) : INFINITY;
    const bool was_explicit = cases.method == PlantMethod::RungeKutta;
    const bool is_lost = was_explicit && (!is_finite || residuals.diverges(x));
    if (report.step_error <= kStepShare && !is_lost) return solved;

    // A force that goes straight, where Runge-Kutta is lost or further from the limit.
    if (was_explicit) {
      PlantCases before = std::move(cases);
      cases = make_cases(setup, recordings, before.steps, PlantMethod::StraightForce);
      if (is_lost || residuals.step_error(x, recordings, options.threads) < report.step_error)
        continue;
      cases = std::move(before);
    }
    if (!is_finite || options.steps > 0 || cases.steps >= kMostSteps) return solved;
    cases = make_cases(setup, recordings, 2 * cases.steps, cases.method);
  }
}

/// The delays of roads that were found, whose uncertainty the intervals do not know.
void add_road_delays(const InPlantSetup& asked, const InPlantSetup& found, InPlantReport& report) {
  for (std::size_t u = 0; u < found.inputs.size(); ++u) {
    if (!asked.inputs[u].finds_later) continue;
    const double later = found.inputs[u].later;
    report.nuisances.push_back({.name = "delay of " + found.inputs[u].channel,
                                .unit = "s",
                                .meaning = "found first, then held",
                                .value = later,
                                .low = later,
                                .high = later});
    report.warnings.push_back(
        found.inputs[u].channel + ": its delay was found to be " + format_number(1000 * later, 5) +
        " ms, and is then held: intervals of other numbers do not know of it");
  }
}

/// Whether the sensitivities at the end of a search, by short differences, are those of leaps: of a
/// law that leaps where the plant rests, or of an integrator whose step is too long. Over a
/// standard deviation of one of the first `count` unknowns, or 1 % where that is less, the
/// residuals change far less than these say.
bool goes_by_leaps(const LeastSquaresProblem& problem, const LeastSquaresReport& solved,
                   const Covariance& spread, std::size_t count, int threads) {
  constexpr double kShortest = 1e-4, kLongest = 1e-2, kFarLess = 0.25;
  const std::size_t n = solved.x.size();
  std::vector<double> at(problem.residuals);
  if (!problem.residual(solved.x, at)) return true;
  std::atomic<bool> leaps = false;
  parallel_for(count, threads, [&](std::size_t k) {
    if (!(problem.lower[k] < problem.upper[k])) return;

    // A standard deviation along one number.
    std::vector<double> x = solved.x, r(problem.residuals);
    const double deviation = std::sqrt(std::max(spread.matrix[k * (n + 1)], 0.0));
    const double size = std::max(1.0, std::abs(x[k])),
                 length = std::clamp(deviation, kShortest * size, kLongest * size);
    x[k] += x[k] + length <= problem.upper[k] ? length : -length;

    // What the sensitivities expect there, and what there is.
    double expected = 0, change = 0;
    for (const std::vector<double>& part : solved.part_matrices)
      expected += length * length * part[k * (n + 1)];
    if (!problem.residual(x, r)) return;
    for (std::size_t i = 0; i < r.size(); ++i) change += (r[i] - at[i]) * (r[i] - at[i]);
    if (change < kFarLess * expected) leaps = true;
  });
  return leaps;
}

/// The same where it is to be feared, with a warning of what it comes from.
bool warn_of_leaps(const PlantResiduals& residuals, const PlantCases& cases,
                   const LeastSquaresReport& solved, const Covariance& spread, int threads,
                   InPlantReport& report) {
  const DriveRange drive = drive_range(cases);
  const bool is_coarse = report.step_error > kStepShare;
  const auto leaps_somewhere = [&](const LawModel& law) {
    return leaps_at_rest(law, drive.low, drive.high);
  };
  if (!is_coarse && std::ranges::none_of(residuals.laws(solved.x), leaps_somewhere)) return false;
  const bool leaps = goes_by_leaps(residuals.problem(0, threads), solved, spread,
                                   residuals.first_state(), threads);
  const std::string cannot = "how certain its numbers are cannot be told";
  if (is_coarse)
    report.warnings.push_back(
        "the integrator's step changes a sensor by " + format_number(100 * report.step_error, 2) +
        " % of its error: the law is too sharp for it" + (leaps ? ", and " + cannot : ""));
  else if (leaps)
    report.warnings.push_back("the law leaps where the damper comes to rest, and " + cannot);
  return leaps;
}

/// For where sensitivities are leaps, or the model so far off that what is left is no chance.
void drop_intervals(InPlantReport& report) {
  for (auto* list : {&report.plant, &report.damper, &report.nuisances})
    for (FittedParameter& p : *list)
      if (!p.fixed) p.low = p.high = std::numeric_limits<double>::quiet_NaN();
}

/// The fit of what is measured, from the best of the starts. No model where the plant diverges.
InPlantReport fit_from_starts(const Law& law, InPlantSetup setup,
                              const std::vector<PlantRecording>& recordings,
                              const InPlantOptions& options, FitDoubts& doubts) {
  const double started = cpu_seconds();
  InPlantReport report;

  // Where the plant's numbers start, and how large the damper's motion and force are: from a fit
  // with a spring and a dashpot in the damper's place.
  PlantCases cases = make_cases(setup, recordings, options.steps);
  require_drive(law, setup, options, report.warnings);
  const PlantStart start = plant_start(setup, recordings, cases, options);
  report.warnings.insert(report.warnings.end(), start.warnings.begin(), start.warnings.end());

  require_profiles(law, setup, start.scale, options);

  const Candidate best = start_in_motion(law, setup, recordings, cases, start, options);
  const DamperUnknowns& unknowns = best.unknowns;
  const std::vector<double>& x = best.x;
  for (const std::string& warning : unknowns.warnings()) report.warnings.push_back(warning);
  if (std::ranges::any_of(setup.sensors,
                          [](const PlantSensor& one) { return one.finds_cutoff.has_value(); }))
    cases = cases_near(best, start, cases, recordings, setup);
  PlantResiduals residuals(setup, cases, unknowns, start.plant, start.scale);

  // What can be told is said before the fit.
  const LeastSquaresReport at =
      describe_at(residuals.problem(0, options.threads), x, {.threads = options.threads});
  report.knowable = knowable_of(residuals, at.part_matrices, x.size());
  residuals.leave_out_forgotten(at);

  LeastSquaresReport solved =
      solve_in_enough_steps(setup, recordings, options, cases, residuals, x, report);

  // Once more beside the noise of inputs and sensors.
  NoisyFit beside{.cases = cases,
                  .noise = {},
                  .found = {},
                  .spread = {},
                  .alone = {},
                  .any_force = {},
                  .with_more = {},
                  .more = {}};
  const auto is_finite = [&] {
    return !solved.part_matrices.empty() && std::isfinite(solved.cost);
  };
  if (is_finite() && has_noisy_inputs(setup)) {
    solved = solve_beside_noise(setup, recordings, options, start.scale, cases, residuals, solved,
                                beside, report);
    report.iterations += solved.iterations;
  }
  report.steps = cases.steps;
  report.method = cases.method;
  report.message = solved.message;
  report.seconds = cpu_seconds() - started;
  if (!is_finite()) {
    report.message = "the plant diverges wherever the fit begins";
    if (const auto channels = noise_alone(setup, recordings); !channels.empty())
      report.message += "; " + join(channels, ", ") + (channels.size() == 1 ? " shows" : " show") +
                        " hardly more than noise: does the plant move enough?";
    return report;
  }
  report.status =
      solved.converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;

  // Intervals: correlated residuals count as one, and sensors differ.
  const Covariance spread = beside.spread.n > 0 ? beside.spread : residuals.covariance_at(solved);
  const bool leaps = warn_of_leaps(residuals, cases, solved, spread, options.threads, report);
  add_parameters(residuals, solved.x, spread, report, reach_of(beside));
  if (!beside.noise.empty()) add_noise(setup, beside.found, report);
  add_warnings(residuals, spread, report);
  if (leaps) drop_intervals(report);
  report.advice.profiles =
      profiles_of({setup, cases, unknowns, residuals, solved, start.plant, start.scale}, spread,
                  profiled(report, options), options);
  residuals.look_at_lines(nullptr);
  cases = beside.cases;

  // What would help.
  const LeastSquaresProblem whole = residuals.problem(0, options.threads);
  if (!options.grade.empty() && !leaps) {
    if (!beside.noise.empty()) solved = describe_at(whole, solved.x, {.threads = options.threads});
    if (is_finite()) {
      std::vector<ParameterProfile> profiles = std::move(report.advice.profiles);
      report.advice = advise({setup, cases, unknowns, residuals, solved, start.plant, start.scale},
                             find_sensor_grade(options.grade, "grade"), options);
      report.advice.profiles = std::move(profiles);
    } else {
      report.warnings.push_back(
          "what more sensors or recordings would add is not told: on the inputs as they were "
          "measured the plant diverges beside what was found");
    }
  }

  doubts = doubts_of({setup, cases, unknowns, residuals, solved, start.plant, start.scale}, whole,
                     options.threads);

  // The whole of each recording in free run, with the end that was held back.
  residuals.describe(solved.x, report.sensors, report.traces, options.threads);
  for (const SensorFigures& figure : report.sensors)
    if (std::isinf(figure.held_back))
      report.warnings.push_back(figure.recording + ": the plant diverges on the time held back (" +
                                figure.channel + ")");
  for (const auto& told : {disagreeing_sensors(setup, report.traces),
                           sensor_doubts(setup, report.sensors, report.traces)})
    std::ranges::copy(told, std::back_inserter(report.warnings));
  if (is_far_off(setup, report.traces)) {
    drop_intervals(report);
  } else if (beside.any_force) {
    report.plant_beside_any_force = std::move(beside.numbers);
    report.warnings.push_back(std::move(beside.told));
  }
  std::vector<LawModel> laws = residuals.laws(solved.x);
  for (std::size_t kind = 0; kind < laws.size(); ++kind)
    report.kinds.push_back({setup.kinds.names[kind], setup.kinds.struts(kind, setup.dampers()),
                            std::make_shared<LawModel>(std::move(laws[kind])),
                            domain_of(kind, setup, report.traces)});
  report.seconds = cpu_seconds() - started;
  return report;
}

/// The same, from more places where the plant diverges from all of the first ones.
InPlantReport fit_somehow(const Law& law, const InPlantSetup& setup,
                          const std::vector<PlantRecording>& recordings,
                          const InPlantOptions& options, FitDoubts& doubts) {
  constexpr int kMoreStarts = 4;
  InPlantReport report = fit_from_starts(law, setup, recordings, options, doubts);
  if (report.has_models()) return report;
  InPlantOptions wider = options;
  wider.starts *= kMoreStarts;
  return fit_from_starts(law, setup, recordings, wider, doubts);
}

/// Power of what is left at the sensors over that of what they showed, on the time that was fitted.
double share_left(const InPlantReport& report) {
  double sum = 0;
  for (const SensorFigures& figure : report.sensors)
    sum += std::pow(figure.training / figure.rms, 2) / static_cast<double>(report.sensors.size());
  return sum;
}

/// Once more with filters in the place of delays that were found unasked, where they may explain
/// more. Taken where that leaves less.
InPlantReport fit_behind_filters(const Law& law, const InPlantSetup& stated,
                                 const InPlantSetup& beside,
                                 const std::vector<PlantRecording>& recordings,
                                 const InPlantOptions& options, FitDoubts doubts,
                                 InPlantReport late) {
  constexpr double kLess = 0.75;
  std::erase_if(doubts.as_if_filtered,
                [&](std::size_t s) { return stated.sensors[s].finds_delay; });
  if (doubts.as_if_filtered.empty()) return late;
  const InPlantSetup behind =
      with_filters_for_delays(beside, doubts.as_if_filtered, late.nuisances);
  FitDoubts then;
  InPlantReport report = fit_somehow(law, behind, recordings, options, then);
  if (!report.has_models() || !(share_left(report) < kLess * share_left(late))) return late;
  report.warnings.push_back(filters_found(stated, behind, report));
  return report;
}

/// Once more with the delays that the plant does not state among the unknowns. Taken where that
/// leaves clearly less.
InPlantReport fit_beside_delays(const Law& law, const InPlantSetup& setup,
                                const std::vector<PlantRecording>& recordings,
                                const InPlantOptions& options, InPlantReport as_stated) {
  constexpr double kClearly = 0.5;
  const InPlantSetup beside = with_delays_unknown(setup);
  if (std::ranges::equal(beside.sensors, setup.sensors, {}, &PlantSensor::finds_delay,
                         &PlantSensor::finds_delay))
    return as_stated;
  FitDoubts doubts;
  InPlantReport report = fit_somehow(law, beside, recordings, options, doubts);
  if (!report.has_models() || !(share_left(report) < kClearly * share_left(as_stated)))
    return as_stated;
  report.warnings.push_back(delays_found(setup, beside, report));
  return fit_behind_filters(law, setup, beside, recordings, options, doubts, std::move(report));
}

/// Once more with dampers that are not alike, of which the plant does not say that they are. Taken
/// where that leaves less; `setup` then says so.
InPlantReport fit_unlike(const Law& law, InPlantSetup& setup,
                         const std::vector<PlantRecording>& recordings,
                         const InPlantOptions& options, InPlantReport as_stated,
                         FitDoubts& doubts) {
  constexpr double kLess = 0.97;
  const InPlantSetup unlike = *with_unlike_dampers(setup);
  FitDoubts then;
  InPlantReport report = fit_somehow(law, unlike, recordings, options, then);
  if (!report.has_models() || !(share_left(report) < kLess * share_left(as_stated)))
    return as_stated;
  report.warnings.push_back(unlike_found(unlike));
  setup = unlike;
  doubts = then;
  return report;
}

}  // namespace

InPlantReport identify_in_plant(const Law& law, const InPlantSetup& setup,
                                const std::vector<PlantRecording>& as_recorded,
                                const InPlantOptions& options) {
  const double started = cpu_seconds();
  require_setup(setup);
  if (!unmeasured_road(setup) && looks_for_road_delay(setup)) {
    const InPlantSetup found = with_found_road_delay(law, setup, as_recorded, options);
    InPlantReport report = identify_in_plant(law, found, as_recorded, options);
    add_road_delays(setup, found, report);
    report.seconds = cpu_seconds() - started;
    return report;
  }
  const std::vector<PlantRecording> recordings = with_followers(setup, as_recorded);
  if (unmeasured_road(setup)) return identify_without_road(law, setup, recordings, options);

  // As it is stated; where that leaves too much, with dampers that are not alike, beside delays.
  FitDoubts doubts;
  InPlantSetup as_taken = with_held_drives(setup, recordings);
  InPlantReport report = fit_somehow(law, as_taken, recordings, options, doubts);
  if (report.has_models() && doubts.are_unlike)
    report = fit_unlike(law, as_taken, recordings, options, std::move(report), doubts);
  if (report.has_models() &&
      (doubts.is_late || seems_late(setup, report.traces) || is_far_off(setup, report.traces)))
    report = fit_beside_delays(law, as_taken, recordings, options, std::move(report));
  report.seconds = cpu_seconds() - started;
  return report;
}

std::vector<double> plant_response(const Plant& plant, const DamperModel& damper,
                                   const InPlantSetup& setup, const PlantRecording& recording,
                                   std::size_t steps) {
  std::vector<PlantInputPlace> inputs;
  for (const PlantInputChannel& input : setup.inputs) inputs.push_back(input.place);
  const DrivenPlant equations(plant, inputs);
  const PlantCases cases = make_cases(setup, {recording}, steps);
  const PlantDriving& driving = cases.all.front().driving;

  const std::vector<const DamperModel*> dampers(setup.dampers(), &damper);
  std::vector<double> state = equations.at_rest(dampers, driving);
  std::vector<std::vector<double>> shown;
  if (!equations.run(dampers, driving, driving.samples, {&setup.sensors.front().place, 1}, state,
                     shown))
    throw Error(recording.name, "the plant diverges with this damper");
  return shown.front();
}

}  // namespace dashpot
