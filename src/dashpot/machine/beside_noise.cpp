#include "dashpot/machine/beside_noise.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dashpot/base/text.h"
#include "dashpot/machine/between_samples.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

/// Where the search for the noise begins: sensors at their scales, inputs and the law's force at a
/// small share of their size.
NoiseSources first_noise(const InPlantSetup& setup, const PlantCases& cases,
                         const PlantResiduals& residuals, const DataScale& scale) {
  constexpr double kShare = 1e-3;
  NoiseSources first;
  for (std::size_t s = 0; s < setup.sensors.size(); ++s)
    first.sensors.push_back(residuals.scale_of(s));
  for (std::size_t u = 0; u < setup.inputs.size(); ++u) {
    const double stated = setup.inputs[u].noise;
    const auto [low, high] = std::ranges::minmax(cases.all.front().driving.value[u]);
    first.inputs.push_back(stated > 0 ? stated : kShare * (high - low));
  }
  first.force.assign(force_memories().size(), kShare * scale.force);
  return first;
}

/// Each recording in free run about x, and what it shows beyond its sensors.
std::vector<InPlantTrace> traces_at(const PlantResiduals& residuals, std::span<const double> x) {
  std::vector<SensorFigures> figures;
  std::vector<InPlantTrace> traces;
  residuals.describe(x, figures, traces);
  return traces;
}

/// The noise of each recording about these traces; empty where a motion tells no spring from a
/// dashpot.
std::vector<RecordingNoise> noise_about(const InPlantSetup& setup, const PlantCases& cases,
                                        const std::vector<InPlantTrace>& traces) {
  std::vector<RecordingNoise> all;
  for (std::size_t c = 0; c < traces.size(); ++c) {
    const InPlantTrace& trace = traces[c];
    const std::size_t first = cases.all[c].first, count = trace.training - first;

    // The spring and the dashpot along this motion.
    std::vector<DamperInput> motion;
    for (std::size_t k = first; k < trace.training; ++k)
      motion.push_back({trace.deflection[k], trace.velocity[k], trace.current[k]});
    const auto stand_in = stand_in_of(motion, std::span(trace.force).subspan(first, count));
    if (!stand_in) return {};
    all.emplace_back(setup, *stand_in, trace.sample_time, count);

    // What is shown beyond the sensors.
    std::vector<std::vector<double>> beyond(setup.sensors.size(), std::vector<double>(count));
    for (std::size_t s = 0; s < beyond.size(); ++s)
      for (std::size_t k = 0; k < count; ++k)
        beyond[s][k] = trace.modelled[s][first + k] - trace.measured[s][first + k];
    all.back().set_beyond(beyond);
  }
  return all;
}

/// The recordings with inputs from which the likely noise of their sensors is taken.
PlantCases without_noise(const PlantCases& as_measured, const InPlantSetup& setup,
                         const std::vector<PlantRecording>& recordings,
                         const std::vector<RecordingNoise>& noise) {
  PlantCases cases = as_measured;
  for (std::size_t c = 0; c < cases.all.size(); ++c) {
    PlantCase& one = cases.all[c];
    const std::vector<std::vector<double>> likely = noise[c].likely_inputs();
    for (std::size_t u = 0; u < setup.inputs.size(); ++u) {
      std::vector<double> input = recordings[c].channel(setup.inputs[u].channel).samples;
      for (std::size_t k = 0; k < likely[u].size(); ++k) input[one.first + k] -= likely[u][k];
      FinerSignal finer = band_limited(input, one.driving.sample_time, one.driving.stride());
      one.driving.value[u] = std::move(finer.value);
      one.driving.rate[u] = std::move(finer.rate);
    }
  }
  return cases;
}

/// Takes from what was measured what the noise of the inputs shows in the model: so the residuals
/// stay those of the inputs as they were measured, and the sensitivities are those without noise.
void keep_residuals(const std::vector<InPlantTrace>& as_measured,
                    const std::vector<InPlantTrace>& without, PlantCases& cases) {
  for (std::size_t c = 0; c < cases.all.size(); ++c)
    for (std::size_t s = 0; s < cases.all[c].measured.size(); ++s)
      for (std::size_t k = 0; k < cases.all[c].measured[s].size(); ++k)
        cases.all[c].measured[s][k] -= as_measured[c].modelled[s][k] - without[c].modelled[s][k];
}

/// How far the first `count` unknowns went, in their standard deviations; the furthest.
double way_between(std::span<const double> from, const LeastSquaresReport& to, std::size_t count) {
  const std::vector<double> ones(to.part_matrices.size(), 1.0);
  const Covariance spread = covariance(to.part_matrices, ones, to.x.size());
  double furthest = 0;
  for (std::size_t k = 0; k < count; ++k)
    if (const double variance = spread.matrix[k * (to.x.size() + 1)]; variance > 0)
      furthest = std::max(furthest, std::abs(to.x[k] - from[k]) / std::sqrt(variance));
  return furthest;
}

/// The columns and residuals of a problem at the end of its search.
struct EndOfSearch {
  std::vector<double> residuals;
  std::vector<std::vector<double>> columns;  ///< empty: of an unknown that is fixed
};

EndOfSearch end_of(const LeastSquaresProblem& problem, const LeastSquaresReport& solved) {
  EndOfSearch end{std::vector<double>(problem.residuals), {}};
  std::vector<double*> places;
  end.columns.resize(solved.x.size());
  for (std::size_t k = 0; k < solved.x.size(); ++k) {
    if (problem.lower[k] < problem.upper[k]) end.columns[k].resize(problem.residuals);
    places.push_back(end.columns[k].empty() ? nullptr : end.columns[k].data());
  }
  problem.jacobian(solved.x, end.residuals, places);
  return end;
}

/// The inverse of the information between the scores' own products, over some neighbouring
/// frequencies each: how large what is left truly is where each unknown shows.
std::vector<double> spread_by_scores(const LeastSquaresProblem& problem, const EndOfSearch& end,
                                     const std::vector<double>& inverse, std::size_t n) {
  std::vector<double> products(n * n);
  for (std::size_t part = 0; part < problem.parts.size(); ++part) {
    const std::size_t first = problem.parts[part], behind = part + 1 < problem.parts.size()
                                                                ? problem.parts[part + 1]
                                                                : problem.residuals;
    std::vector<double> score(n);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = first; i < behind && !end.columns[k].empty(); ++i)
        score[k] += end.columns[k][i] * end.residuals[i];
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t m = 0; m < n; ++m) products[k * n + m] += score[k] * score[m];
  }
  const auto parts = static_cast<double>(problem.parts.size());
  const double freedom = std::max(1.0, parts - static_cast<double>(n)) / parts;
  for (double& value : products) value /= freedom;
  return product(product(inverse, products, n), inverse, n);
}

/// The covariance of the unknowns at the end of a search beside the noise.
Covariance spread_beside_noise(const LeastSquaresProblem& problem,
                               const LeastSquaresReport& solved) {
  const std::size_t n = solved.x.size();
  const std::vector<double> ones(solved.part_matrices.size(), 1.0);
  Covariance spread = covariance(solved.part_matrices, ones, n);
  spread.matrix = spread_by_scores(problem, end_of(problem, solved), spread.matrix, n);
  return spread;
}

}  // namespace

bool has_noisy_inputs(const InPlantSetup& setup) {
  return std::ranges::any_of(setup.inputs, [&](const PlantInputChannel& one) {
    return one.noise > 0 || (one.place.kind != PlantInput::Force && setup.sensors.size() > 1);
  });
}

LeastSquaresReport solve_beside_noise(const InPlantSetup& setup,
                                      const std::vector<PlantRecording>& recordings,
                                      const InPlantOptions& options, const DataScale& scale,
                                      PlantCases& cases, PlantResiduals& residuals,
                                      LeastSquaresReport solved, NoisyFit& fit,
                                      InPlantReport& report) {
  constexpr int kTurns = 15, kIterations = 10;
  constexpr double kTolerance = 1e-6, kNear = 3, kStays = 0.2;  // of a standard deviation
  LeastSquaresOptions solver;
  solver.max_iterations = kIterations;
  solver.function_tolerance = kTolerance;
  solver.threads = options.threads;
  solver.on_iteration = [&](int, double, std::span<const double>) { options.monitor.check(); };

  fit.cases = cases;
  fit.found.sources = first_noise(setup, cases, residuals, scale);
  int iterations = 0;
  bool has_enough_steps = false, stays = false;
  for (int turn = 0; turn < kTurns && !stays; ++turn) {
    options.monitor.report("fit beside noise, turn " + std::to_string(turn + 1), 0.7 + 0.02 * turn);

    // The noise about the unknowns.
    cases = fit.cases;
    const std::vector<InPlantTrace> traces = traces_at(residuals, solved.x);
    std::vector<RecordingNoise> noise = noise_about(residuals.setup_at(solved.x), cases, traces);
    if (noise.empty()) break;
    fit.found = find_noise(noise, setup, fit.found.sources, options.threads);
    fit.noise = std::move(noise);

    // The unknowns beside it.
    cases = without_noise(fit.cases, setup, recordings, fit.noise);
    keep_residuals(traces, traces_at(residuals, solved.x), cases);
    residuals.look_at_lines(&fit.noise);
    const LeastSquaresProblem problem = residuals.problem(0, options.threads);
    LeastSquaresReport next = solve(problem, solved.x, solver);
    if (!std::isfinite(next.cost) || next.part_matrices.empty()) break;
    const double way = way_between(solved.x, next, residuals.first_state());
    iterations += next.iterations;
    solved = std::move(next);

    // Near the end, whether the steps are enough: their error falls with their square.
    if (!has_enough_steps && way < kNear) {
      PlantCases without = std::move(cases);
      cases = fit.cases;
      report.step_error = residuals.step_error(solved.x, recordings);
      std::size_t steps = cases.steps;
      for (double error = report.step_error; error > kStepShare && steps < kMostSteps; error /= 4)
        steps *= 2;
      has_enough_steps = options.steps > 0 || steps == cases.steps;
      if (!has_enough_steps) {
        cases = fit.cases = make_cases(setup, recordings, steps, cases.method);
        continue;
      }
      cases = std::move(without);
    }
    if (has_enough_steps || turn + 1 == kTurns) fit.spread = spread_beside_noise(problem, solved);
    stays = has_enough_steps && way < kStays;
  }
  if (fit.noise.empty())
    report.warnings.push_back(
        "the noise of the inputs could not be told: the numbers of the plant may lean by it, and "
        "their intervals do not know it");
  else if (!stays)
    report.warnings.push_back(
        "the noise of the inputs and the unknowns had not settled beside each other: do not rely "
        "on the intervals");
  solved.iterations = iterations;
  return solved;
}

void add_noise(const InPlantSetup& setup, const NoiseFound& found, InPlantReport& report) {
  std::size_t j = 0;
  const auto add = [&](std::string name, std::string unit, double value) {
    const double half = kNormal95 * found.uncertainty[j++];
    if (half > 0)
      report.nuisances.push_back({.name = std::move(name),
                                  .unit = std::move(unit),
                                  .meaning = {},
                                  .value = value,
                                  .low = value * std::exp(-half),
                                  .high = value * std::exp(half)});
  };
  for (std::size_t s = 0; s < setup.sensors.size(); ++s)
    add("noise of " + setup.sensors[s].channel, unit_of(setup.sensors[s].place.quantity),
        found.sources.sensors[s]);
  for (std::size_t u = 0; u < setup.inputs.size(); ++u)
    add("noise of " + setup.inputs[u].channel, unit_of(setup.inputs[u].place.kind),
        found.sources.inputs[u]);
  for (std::size_t e = 0; e < force_memories().size(); ++e)
    add("error of the force over " + format_number(force_memories()[e]) + " s", "N",
        found.sources.force[e]);
}

}  // namespace dashpot
