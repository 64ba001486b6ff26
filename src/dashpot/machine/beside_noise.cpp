#include "dashpot/machine/beside_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>

#include "dashpot/base/text.h"
#include "dashpot/numerics/distributions.h"

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

/// Solves it until the first `count` unknowns stay within so many of their standard deviations:
/// what moves the cost then are nuisances that next to nothing tells.
LeastSquaresReport solve_until_near(const LeastSquaresProblem& problem, std::vector<double> x,
                                    std::size_t count, double near, const InPlantOptions& options) {
  constexpr int kPieces = 6, kIterations = 2;
  LeastSquaresOptions solver;
  solver.max_iterations = kIterations;
  solver.function_tolerance = 1e-6;
  solver.threads = options.threads;
  solver.line_search = LineSearch::ByResiduals;
  solver.on_iteration = [&](int, double, std::span<const double>) { options.monitor.check(); };

  // Two iterations after the other, and a look at how far they went.
  LeastSquaresReport solved;
  int iterations = 0;
  for (int piece = 0; piece < kPieces; ++piece) {
    solved = solve(problem, x, solver);
    iterations += solved.iterations;
    if (!std::isfinite(solved.cost) || solved.part_matrices.empty() || solved.converged) break;
    if (way_between(x, solved, count) < near) {
      solved.converged = true;
      solved.message =
          "The unknowns stay within " + format_number(near) + " of their standard deviations.";
      break;
    }
    x = solved.x;
  }
  solved.iterations = iterations;
  return solved;
}

/// What the damper may show beside its law: a force that follows its deflection, or its velocity.
struct MoreForce {
  const char *name, *unit;
  std::vector<double> DamperTrace::* follows;
};
constexpr std::array kMore = {MoreForce{"spring", "N/m", &DamperTrace::deflection},
                              MoreForce{"dashpot", "N*s/m", &DamperTrace::velocity}};

/// The sensitivity to one N/m or N*s/m of it, as rows of the residuals.
std::vector<double> column_of(const MoreForce& more, const LeastSquaresProblem& problem,
                              const PlantCases& cases, const PlantResiduals& residuals,
                              const std::vector<InPlantTrace>& traces,
                              const std::vector<RecordingNoise>& noise) {
  std::vector<double> column(problem.residuals);
  for (std::size_t c = 0, at = 0; c < noise.size(); ++c) {
    const std::size_t count = noise[c].lines() * noise[c].rows_per_line();
    const std::span<double> rows = std::span(column).subspan(at, count);
    at += count;
    std::vector<std::span<const double>> forces;
    for (const DamperTrace& damper : traces[c].dampers)
      forces.push_back(std::span(damper.*more.follows).subspan(cases.all[c].first));
    noise[c].put_forces(forces, rows);
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] /= residuals.scale_of(i % noise[c].rows_per_line() / 2);
  }
  return column;
}

/// The share of a column that no other can make, where `spread` is the inverse of their products.
double own_share(const std::vector<double>& column, const EndOfSearch& end,
                 const Covariance& spread) {
  const auto along = [&](const std::vector<double>& other) {
    return std::inner_product(other.begin(), other.end(), column.begin(), 0.0);
  };
  std::vector<double> products;
  for (const std::vector<double>& other : end.columns) products.push_back(along(other));
  const double length = along(column);
  return length > 0 ? 1 - spread.variance(0, products) / length : 0;
}

/// How certain the unknowns are at the end of a search beside the noise, where the plant's numbers
/// go beside any force once they stay beside the law, and whether the damper shows more than its
/// law has.
void tell_spread(const FitBesideNoise& at, const LeastSquaresReport& solved, bool stays,
                 NoisyFit& fit) {
  constexpr double kOwnShare = 0.01, kChance = 0.01;
  const std::size_t n = solved.x.size();
  std::optional<EndOfSearch> found = end_of(at.problem, solved.x);
  if (!found) return;
  EndOfSearch end = std::move(*found);

  // Of the unknowns alone.
  const std::vector<double> ones(solved.part_matrices.size(), 1.0);
  fit.spread = covariance(solved.part_matrices, ones, n);
  fit.alone.emplace(pieces_of(end, fit.noise, at.threads), n);

  // Beside any force.
  const std::vector<InPlantTrace> traces = traces_at(at.residuals, solved.x, at.threads);
  if (stays) fit.any_force = beside_any_force(at, end, *fit.alone);

  // Beside what the law cannot make.
  std::vector<const MoreForce*> asked;
  std::vector<std::vector<double>> columns;
  for (const MoreForce& more : kMore) {
    columns.push_back(column_of(more, at.problem, at.cases, at.residuals, traces, fit.noise));
    if (own_share(columns.back(), end, fit.spread) > kOwnShare)
      asked.push_back(&more);
    else
      columns.pop_back();
  }
  fit.spread.matrix = fit.alone->covariance();
  fit.more.clear();
  fit.with_more.reset();
  if (asked.empty()) return;
  std::ranges::move(columns, std::back_inserter(end.columns));
  Jackknife with_more(pieces_of(end, fit.noise, at.threads), n + asked.size());
  const double one[] = {1};
  for (std::size_t k = 0; k < asked.size(); ++k) {
    const double value = with_more.step()[n + k];
    if (std::abs(value) < with_more.half(n + k, one, kChance / 2)) continue;
    const double half = with_more.half(n + k, one);
    fit.more.push_back(
        std::string("beside this law the damper shows a ") + asked[k]->name + " of " +
        format_number(value, 3) + " " + asked[k]->unit + " (" + format_number(value - half, 3) +
        " ... " + format_number(value + half, 3) +
        "): intervals reach to where the numbers go with it; try a law that makes it");
  }
  if (!fit.more.empty()) fit.with_more.emplace(std::move(with_more));
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
  constexpr int kTurns = 15;
  constexpr double kNear = 3, kStays = 0.2, kShort = 0.02;  // of a standard deviation
  fit.cases = cases;
  fit.found.sources = first_noise(setup, cases, residuals, scale);
  int iterations = 0;
  bool has_enough_steps = false, stays = false;
  for (int turn = 0; turn < kTurns && !stays; ++turn) {
    options.monitor.report("fit beside noise, turn " + std::to_string(turn + 1), 0.7 + 0.02 * turn);

    // The noise about the unknowns.
    cases = fit.cases;
    const std::vector<InPlantTrace> traces = traces_at(residuals, solved.x, options.threads);
    std::vector<RecordingNoise> noise =
        noise_about(residuals.setup_at(solved.x), cases, traces, options.threads);
    if (noise.empty()) break;
    fit.found = find_noise(noise, setup, fit.found.sources, options.threads);
    fit.noise = std::move(noise);

    // The unknowns beside it.
    cases = without_noise(fit.cases, setup, recordings, fit.noise, options.threads);
    keep_residuals(traces, traces_at(residuals, solved.x, options.threads), cases);
    residuals.look_at_lines(&fit.noise);
    const LeastSquaresProblem problem = residuals.problem(0, options.threads);
    LeastSquaresReport next =
        solve_until_near(problem, solved.x, residuals.first_state(), kShort, options);
    if (!std::isfinite(next.cost) || next.part_matrices.empty()) break;
    const double way = way_between(solved.x, next, residuals.first_state());
    iterations += next.iterations;
    solved = std::move(next);

    // Near the end, whether the steps are enough: their error falls with their square.
    if (!has_enough_steps && way < kNear) {
      PlantCases without = std::move(cases);
      cases = fit.cases;
      report.step_error = residuals.step_error(solved.x, recordings, options.threads);
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
    stays = has_enough_steps && way < kStays;
    const FitBesideNoise at{.setup = setup,
                            .recordings = recordings,
                            .problem = problem,
                            .x = solved.x,
                            .as_measured = fit.cases,
                            .cases = cases,
                            .residuals = residuals,
                            .noise = fit.noise,
                            .sources = fit.found.sources,
                            .force = scale.force,
                            .threads = options.threads};
    if (has_enough_steps || turn + 1 == kTurns) tell_spread(at, solved, stays, fit);
    if (fit.any_force) {
      fit.numbers = numbers_beside_any_force(*fit.any_force, at);
      fit.told = told_beside_any_force(*fit.any_force, at, *fit.alone);
    }
  }
  report.warnings.insert(report.warnings.end(), fit.more.begin(), fit.more.end());
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

Reach reach_of(const NoisyFit& fit) {
  if (!fit.alone) return {};
  return [&fit](std::size_t first, std::span<const double> weights) {
    const double half = fit.alone->half(first, weights);
    double below = half, above = half;
    const auto reach = [&](const Jackknife& other, const std::vector<double>& ways) {
      double way = 0;
      for (std::size_t k = 0; k < weights.size(); ++k) way += weights[k] * ways[first + k];
      const auto [low, high] = reach_to(half, way, other.half(first, weights));
      below = std::max(below, low);
      above = std::max(above, high);
    };
    if (fit.with_more) reach(*fit.with_more, fit.with_more->step());
    if (fit.any_force && first < fit.any_force->way.size())
      reach(fit.any_force->told, fit.any_force->way);
    return std::pair(below, above);
  };
}

void add_noise(const InPlantSetup& setup, const NoiseFound& found, InPlantReport& report) {
  constexpr double kWidest = 4.6;  // a factor of 100: beyond, there is as good as none of it
  std::size_t j = 0;
  const auto add = [&](std::string name, std::string unit, double value) {
    const double half = kNormal95 * found.uncertainty[j++];
    if (!(half > 0)) return;
    FittedParameter noise{
        .name = std::move(name), .unit = std::move(unit), .meaning = {}, .value = value};
    const double wide = half < kWidest ? half : std::numeric_limits<double>::quiet_NaN();
    noise.low = value * std::exp(-wide);
    noise.high = value * std::exp(wide);
    report.nuisances.push_back(std::move(noise));
  };

  // In the order of the uncertainties.
  const Plant plant = make_plant(*setup.model, setup.known);
  for (std::size_t s = 0; s < setup.sensors.size(); ++s)
    add("noise of " + setup.sensors[s].channel, unit_of(setup.sensors[s].place, plant),
        found.sources.sensors[s]);
  for (std::size_t u = 0; u < setup.inputs.size(); ++u)
    if (setup.inputs[u].follows.empty())
      add("noise of " + setup.inputs[u].channel, unit_of(setup.inputs[u].place.kind),
          found.sources.inputs[u]);
  for (std::size_t e = 0; e < force_memories().size(); ++e)
    add("error of the force over " + format_number(force_memories()[e]) + " s", "N",
        found.sources.force[e]);
}

}  // namespace dashpot
