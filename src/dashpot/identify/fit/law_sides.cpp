#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "dashpot/base/text.h"
#include "dashpot/damper/law_side.h"
#include "dashpot/identify/fit/law_task.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/record/trial_parts.h"

namespace dashpot {
namespace {

constexpr double kWorthATrial = 0.05;  // of what a law leaves, that is alike in both directions
constexpr double kWorthApart = 0.1;    // of the squared error on records held back
constexpr double kMostFolds = 0.6;     // of them must be better

/// A valve of one direction, in the terms of a law with_side(): its friction is a line over the
/// drive.
struct Side {
  double friction = 0, slope = 0, viscous = 0, speed = 0;
};

/// The valve that a fit with both directions alike lacks most, and what share of its squared
/// residuals this would take away.
struct Lack {
  Side side;
  double share = 0;
};

/// What a valve of this speed adds to the force's even part, half of what it gives: friction, that
/// per unit of the drive, viscous damping.
std::array<double, 3> even_part(double velocity, double drive, double speed) {
  const double friction = std::abs(std::tanh(velocity / speed)) / 2;
  return {friction, drive * friction, std::abs(velocity) / 2};
}

/// Least squares of the residuals on what valves of this speed would add, record by record.
Lack lack_at(const LawTask& task, const LawResiduals& residuals, std::span<const double> errors,
             double speed) {
  constexpr std::size_t kColumns = 3;
  constexpr double kRidge = 1e-9;  // one level of the drive cannot tell the slope
  std::array<double, kColumns * kColumns> matrix{};
  std::array<double, kColumns> right{}, x{};
  double squares = 0;

  // The sums over all records, each about its mean.
  for (std::size_t r = 0; r < task.training.size(); ++r) {
    const auto [first, count] = residuals.segments()[r];
    const std::vector<DamperInput> inputs = damper_inputs(task.training[r], task.drive_unit);
    std::vector<std::array<double, kColumns>> rows;
    std::array<double, kColumns> mean{};
    for (std::size_t k = inputs.size() - count; k < inputs.size(); ++k) {
      rows.push_back(even_part(inputs[k].velocity, inputs[k].current, speed));
      for (std::size_t c = 0; c < kColumns; ++c)
        mean[c] += rows.back()[c] / static_cast<double>(count);
    }

    for (std::size_t k = 0; k < count; ++k) {
      const double error = errors[first + k];
      squares += error * error;
      for (std::size_t a = 0; a < kColumns; ++a) {
        right[a] += (rows[k][a] - mean[a]) * error;
        for (std::size_t b = 0; b < kColumns; ++b)
          matrix[a * kColumns + b] += (rows[k][a] - mean[a]) * (rows[k][b] - mean[b]);
      }
    }
  }
  for (std::size_t c = 0; c < kColumns; ++c) matrix[c * (kColumns + 1)] *= 1 + kRidge;

  if (!(squares > 0) || !solve_positive_definite(matrix, right, x)) return {};
  return {{x[0], x[1], x[2], speed},
          std::inner_product(x.begin(), x.end(), right.begin(), 0.0) / squares};
}

/// Over a few speeds at which friction may set in.
Lack greatest_lack(const LawTask& task, std::span<const double> x) {
  const LawResiduals residuals = task.residuals({});
  std::vector<double> errors(residuals.size());
  if (!residuals.evaluate(x, errors)) return {};

  const double top = data_scale(task.training, task.drive_unit).speed;
  Lack greatest;
  for (const double share : {0.02, 0.06, 0.2})
    if (Lack lack = lack_at(task, residuals, errors, share * top); lack.share > greatest.share)
      greatest = lack;
  return greatest;
}

bool is_asked_for(const LawTask& task) {
  return std::ranges::any_of(side_rows(), [&](const ParamInfo& row) {
    const ParameterChoice choice = choice_for(task.options.choices, task.model, row);
    return choice.fixed || choice.form || choice.free || choice.bounds || choice.prior;
  });
}

/// The unknowns of the fit with both directions alike, and of a valve beside it.
std::vector<double> start_of(const LawTask& apart, const LawModel& alike, const Side& side) {
  const std::size_t first = apart.law.side_row;
  Dependence parameters = alike.parameters();
  for (std::size_t row = first; row < apart.law.params.size(); ++row) {
    parameters.forms.push_back(apart.unknowns.form_of(row));
    parameters.coefficients.emplace_back(coefficient_count(parameters.forms.back()), 0.0);
  }

  // Friction by what its form has room for; an exponential starts level.
  std::vector<double>& friction = parameters.coefficients[first];
  friction[0] = side.friction;
  if (parameters.forms[first] == Form::Exponential)
    friction = {side.friction, side.friction, 1};
  else if (friction.size() > 1)
    friction[1] = side.slope;
  parameters.coefficients[first + 1][0] = side.viscous;
  parameters.coefficients[first + 2][0] = side.speed;
  return apart.unknowns.of(
      LawModel(apart.law, std::move(parameters), apart.drive_unit, alike.lag_rate()));
}

/// Squared errors on what a short fit from x without it leaves of the held-back records.
double held_back_squares(const LawTask& task, const Fold& fold, const std::vector<double>& x) {
  constexpr int kIterations = 15;
  constexpr double kTolerance = 1e-3;
  const LawResiduals known(task.unknowns, fold.training, task.drive_unit, task.options.offset,
                           task.trial_thinning());
  const LeastSquaresReport fitted = solve(known.problem(0, task.options.threads), x,
                                          solver_options(task.options, kIterations, kTolerance));

  const LawResiduals unseen(task.unknowns, fold.left_out, task.drive_unit, task.options.offset);
  std::vector<double> errors(unseen.size());
  if (!std::isfinite(fitted.cost) || !unseen.evaluate(fitted.x, errors)) return INFINITY;
  return std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0);
}

}  // namespace

bool take_side_apart(const LawTask& alike, const LawTask& apart, LawSolution& best) {
  if (alike.options.symmetric || status_of(best.solved) == FitReport::Status::Failed) return false;

  // Nothing to gain where the errors differ between the directions.
  const bool asked = is_asked_for(apart);
  const Lack lack = greatest_lack(alike, best.solved.x);
  if (!asked && lack.share < kWorthATrial) return false;

  const LawModel model = alike.unknowns.model(best.solved.x);
  LawSolution fitted = solve_all(apart, start_of(apart, model, lack.side));
  if (status_of(fitted.solved) == FitReport::Status::Failed) return false;

  // Both ways by records held back in turn, whose motions and drives others show as well: how far a
  // law reaches beyond its data is another question.
  const std::vector<Fold> folds = hold_back(alike.training, {.by = LeaveOut::By::Record});
  double with = 0, without = 0, samples = 0, better = 0;
  for (const Fold& fold : folds) {
    const double one = held_back_squares(apart, fold, fitted.solved.x);
    const double other = held_back_squares(alike, fold, best.solved.x);
    with += one;
    without += other;
    better += one < other;
    for (const Record& record : fold.left_out)
      samples += static_cast<double>(record.size() - record.warm_up);
  }
  const bool pays = with < (1 - kWorthApart) * without &&
                    better >= kMostFolds * static_cast<double>(folds.size());
  if (!asked && !pays) return false;

  best = std::move(fitted);
  best.sides = "rebound and compression are apart: on training records held back, the RMSE is " +
               format_number(std::sqrt(with / samples), 3) + " N in place of " +
               format_number(std::sqrt(without / samples), 3) + " N (--symmetric keeps them alike)";
  return true;
}

}  // namespace dashpot
