#include "dashpot/design/design_law.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/numerics/least_squares.h"

namespace dashpot {
namespace {

/// The points at which the law is fitted: current, velocity and force.
struct ForceGrid {
  double current = 0, velocity = 0;  ///< the largest
  struct Point {
    double current, velocity, force;
  };
  std::vector<Point> points;
  double largest = 0;
};

ForceGrid force_grid(const DamperDescription& damper, const DesignRequest& request,
                     const DesignModel& model) {
  constexpr int kCurrents = 9, kVelocities = 12;
  constexpr double kUsualCurrent = 1, kUsualVelocity = 0.5;  // where the request names none

  // The largest current and speed that the request names bound the grid.
  ForceGrid grid;
  const auto widen = [&](const DamperOperation& at) {
    grid.current = std::max(grid.current, std::abs(at.current));
    grid.velocity = std::max(grid.velocity, std::abs(at.velocity));
  };
  for (const DesignGoal& goal : request.goals) widen(goal.at);
  for (const DesignConstraint& constraint : request.constraints) widen(constraint.at);
  if (grid.current == 0) grid.current = kUsualCurrent;
  if (grid.velocity == 0) grid.velocity = kUsualVelocity;

  // The model's forces at even steps of both, the speeds without 0.
  for (int i = 0; i < kCurrents; ++i)
    for (int k = 1; k <= kVelocities; ++k) {
      const DamperOperation at{grid.current * i / (kCurrents - 1), grid.velocity * k / kVelocities};
      grid.points.push_back({at.current, at.velocity, model.evaluate(damper, at).force});
      grid.largest = std::max(grid.largest, std::abs(grid.points.back().force));
    }
  return grid;
}

/// The law's dependence with unknowns c0_a, c0_b and the coefficients of f_y.
Dependence dependence(Form form, std::span<const double> x) {
  return {{Form::Linear, form, Form::Constant, Form::Constant},
          {{x[0], x[1]}, {x.begin() + 2, x.end()}, {0}, {0}}};
}

struct LawFit {
  Dependence parameters;
  double rms = HUGE_VAL;
};

LawFit fit(const Law& law, const ForceGrid& grid, Form form) {
  const ForceGrid::Point &off = grid.points.front(), &on = grid.points[grid.points.size() - 1];

  // Starts from half the force without current as damping and half as yielding force, and from the
  // force at the largest current and speed as the yielding force.
  LeastSquaresProblem problem;
  problem.residuals = grid.points.size();
  std::vector<double> start{0.5 * off.force / grid.velocity, 0, 0.5 * off.force};
  if (form == Form::Exponential)
    start.insert(start.end(), {on.force, 2 / grid.current});
  else
    start.insert(start.end(), {on.force / grid.current, 0, 0});

  // Damping, its rise and the force without current cannot be negative; nor can the coefficients of
  // an exponential.
  problem.lower.assign(start.size(), -HUGE_VAL);
  problem.upper.assign(start.size(), HUGE_VAL);
  std::fill_n(problem.lower.begin(), 3, 0.);
  if (form == Form::Exponential) problem.lower[3] = problem.lower[4] = 0;

  // Residuals in shares of the largest force, so that the tolerances of the solver fit every
  // damper.
  problem.residual = [&](std::span<const double> x, std::span<double> r) {
    const Dependence parameters = dependence(form, x);
    for (std::size_t k = 0; k < r.size(); ++k) {
      const ForceGrid::Point& at = grid.points[k];
      double values[4];
      for (std::size_t p = 0; p < 4; ++p) values[p] = parameters.at(p, at.current);
      r[k] = (law.force(values, 0, at.velocity, nullptr) - at.force) / grid.largest;
    }
    return true;
  };

  // The cost is half the sum of squares: back to a root mean square in N.
  const LeastSquaresReport report = solve(problem, std::move(start), {.threads = 1});
  return {dependence(form, report.x),
          grid.largest * std::sqrt(2 * report.cost / static_cast<double>(grid.points.size()))};
}

}  // namespace

DesignLaw law_of_design(const DamperDescription& damper, const DesignRequest& request,
                        const DesignModel& model) {
  const Law& law = find_law("plate_bingham");
  const ForceGrid grid = force_grid(damper, request, model);

  // The nearer of the two forms, and the coil's lag at the largest current.
  const LawFit exponential = fit(law, grid, Form::Exponential), cubic = fit(law, grid, Form::Cubic);
  const LawFit& best = exponential.rms <= cubic.rms ? exponential : cubic;
  const double lag = 1 / model.evaluate(damper, {grid.current, grid.velocity}).time_constant;

  // The model file: valid within the stroke and the grid, with the fit's error as its quality.
  DesignLaw result{.rms_error = best.rms, .largest_force = grid.largest};
  result.file.model = std::make_unique<LawModel>(law, best.parameters, DriveUnit::Ampere,
                                                 std::isfinite(lag) ? lag : 0);
  result.file.domain = {-0.5 * damper.stroke, 0.5 * damper.stroke, -grid.velocity, grid.velocity, 0,
                        grid.current};
  result.file.provenance.dataset = damper.name;
  result.file.quality = Value::object({{"against", model.name()},
                                       {"rms_error_N", best.rms},
                                       {"largest_force_N", grid.largest},
                                       {"points", grid.points.size()}});
  return result;
}

}  // namespace dashpot
