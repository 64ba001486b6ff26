#include "dashpot/design/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/parallel.h"
#include "dashpot/base/random.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

using Rows = std::vector<std::vector<double>>;

/// The figures of the damper made with these shares of the tolerances; NaN where it cannot be made.
std::vector<double> figures_of(const DesignProblem& problem, const DamperDescription& design,
                               const std::vector<double>& shares, bool rides) {
  const DesignRequest& request = problem.request();
  const DamperDescription damper = problem.made(design, shares);
  try {
    require_possible(damper, "");
  } catch (const Error&) {
    return std::vector<double>(request.goals.size() + request.constraints.size(), NAN);
  }
  return (rides ? problem.figures(damper) : problem.figures_unridden(damper)).values;
}

Rows draw(std::size_t samples, std::size_t count, Random& random) {
  Rows rows(samples, std::vector<double>(count));
  for (auto& row : rows)
    for (double& share : row) share = random.uniform(-1, 1);
  return rows;
}

bool holds_all(const DesignRequest& request, const std::vector<double>& figures) {
  for (std::size_t k = 0; k < request.constraints.size(); ++k) {
    const DesignConstraint& own = request.constraints[k];
    const double figure = figures[request.goals.size() + k];
    if (!(own.at_least ? figure >= own.bound : figure <= own.bound)) return false;
  }
  return true;
}

/// f(A), f(B) and, for every tolerance, f(A with that column of B).
struct Samples {
  Rows a, b;
  std::vector<Rows> mixed;
};

Samples sample(const DesignProblem& problem, const DamperDescription& design,
               const SensitivityOptions& options, bool rides) {
  // Two independent draws of all tolerances.
  Random random(options.seed);
  const std::size_t size = rides ? options.ridden : options.samples;
  const std::size_t count = problem.request().tolerances.size();
  const Rows a = draw(size, count, random), b = draw(size, count, random);

  // Each damper of A also with one tolerance at a time from B.
  Samples samples{Rows(size), Rows(size), std::vector<Rows>(count, Rows(size))};
  parallel_for(size, options.threads, [&](std::size_t k) {
    samples.a[k] = figures_of(problem, design, a[k], rides);
    samples.b[k] = figures_of(problem, design, b[k], rides);
    for (std::size_t t = 0; t < count; ++t) {
      std::vector<double> mixed = a[k];
      mixed[t] = b[k][t];
      samples.mixed[t][k] = figures_of(problem, design, mixed, rides);
    }
  });
  return samples;
}

void add_shares(const Samples& samples, std::size_t figure, Sensitivity::Figure& result) {
  // Mean and variance over both draws.
  const auto count = static_cast<double>(samples.a.size());
  double sum = 0, squares = 0;
  for (const Rows* rows : {&samples.a, &samples.b})
    for (const auto& row : *rows) sum += row[figure];
  const double mean = sum / (2 * count);
  for (const Rows* rows : {&samples.a, &samples.b})
    for (const auto& row : *rows) squares += (row[figure] - mean) * (row[figure] - mean);
  const double variance = squares / (2 * count);

  // First-order shares by Saltelli's estimator, total ones by Jansen's.
  for (const Rows& mixed : samples.mixed) {
    double alone = 0, total = 0;
    for (std::size_t k = 0; k < mixed.size(); ++k) {
      const double a = samples.a[k][figure], step = mixed[k][figure] - a;
      alone += (samples.b[k][figure] - mean) * step;
      total += 0.5 * step * step;
    }

    // A figure that only rounding moves has no shares.
    const bool varies = variance > 1e-24 * mean * mean;
    result.alone.push_back(varies ? alone / count / variance : 0);
    result.total.push_back(varies ? total / count / variance : 0);
  }
}

void add_range(const Samples& samples, std::size_t figure, Sensitivity::Figure& result) {
  std::vector<double> all;
  for (const Rows* rows : {&samples.a, &samples.b})
    for (const auto& row : *rows) all.push_back(row[figure]);
  std::ranges::sort(all, [](double x, double y) { return std::isnan(y) ? !std::isnan(x) : x < y; });
  result.low = all[all.size() / 20];
  result.high = all[all.size() - 1 - all.size() / 20];
}

/// Derivatives by central differences of 1 % of the tolerance, times the tolerance.
void add_local(const DesignProblem& problem, const DamperDescription& design, Sensitivity& result) {
  constexpr double kStep = 0.01;
  const std::size_t count = problem.request().tolerances.size();
  for (std::size_t t = 0; t < count; ++t) {
    std::vector<double> shares(count, 0.);
    shares[t] = kStep;
    const std::vector<double> up = figures_of(problem, design, shares, true);
    shares[t] = -kStep;
    const std::vector<double> down = figures_of(problem, design, shares, true);
    for (std::size_t k = 0; k < result.figures.size(); ++k)
      result.figures[k].local.push_back((up[k] - down[k]) / (2 * kStep));
  }
}

}  // namespace

Sensitivity sensitivity(const DesignProblem& problem, const DamperDescription& design,
                        const SensitivityOptions& options) {
  Sensitivity result;
  for (const double figure : problem.figures(design).values)
    result.figures.push_back({.drawn = figure});
  if (problem.request().tolerances.empty()) return result;

  // Derivatives at the drawing.
  add_local(problem, design, result);

  // Spread and shares of variance over the dampers made; rides are long, and have fewer of them.
  bool any_ride = false, all_ride = true, constrains_ride = false;
  for (std::size_t k = 0; k < result.figures.size(); ++k) {
    any_ride = any_ride || problem.needs_ride(k);
    all_ride = all_ride && problem.needs_ride(k);
    constrains_ride =
        constrains_ride || (problem.needs_ride(k) && k >= problem.request().goals.size());
  }
  const Samples unridden = all_ride ? Samples() : sample(problem, design, options, false);
  const Samples ridden = any_ride ? sample(problem, design, options, true) : Samples();
  for (std::size_t k = 0; k < result.figures.size(); ++k) {
    const Samples& samples = problem.needs_ride(k) ? ridden : unridden;
    add_range(samples, k, result.figures[k]);
    add_shares(samples, k, result.figures[k]);
  }

  // The share of them that holds every constraint.
  const Samples& all = constrains_ride || all_ride ? ridden : unridden;
  std::size_t holding = 0;
  for (const Rows* rows : {&all.a, &all.b})
    for (const auto& row : *rows) holding += holds_all(problem.request(), row);
  result.holding = static_cast<double>(holding) / static_cast<double>(2 * all.a.size());
  return result;
}

}  // namespace dashpot
