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

/// Sums of squares and products over all samples, for the regression of residuals on what alters
/// both directions alike and on what a valve of one direction adds to their even part.
class SideRegression {
 public:
  /// The residuals of one record, and its motion; `speed`: that over which friction sets in.
  void add(std::span<const double> errors, std::span<const DamperInput> inputs, double speed) {
    // Each function of the motion about its mean over the record, as its offset is free.
    std::vector<Row> rows;
    Row mean{};
    for (const DamperInput& input : inputs) {
      const double friction = std::tanh(input.velocity / speed) / 2, v = input.velocity / 2;
      rows.push_back({friction, input.current * friction, v, std::abs(friction),
                      input.current * std::abs(friction), std::abs(v)});
      for (std::size_t c = 0; c < kColumns; ++c)
        mean[c] += rows.back()[c] / static_cast<double>(inputs.size());
    }

    for (std::size_t k = 0; k < rows.size(); ++k) {
      squares_ += errors[k] * errors[k];
      for (std::size_t a = 0; a < kColumns; ++a) {
        right_[a] += (rows[k][a] - mean[a]) * errors[k];
        for (std::size_t b = 0; b < kColumns; ++b)
          matrix_[a * kColumns + b] += (rows[k][a] - mean[a]) * (rows[k][b] - mean[b]);
      }
    }
  }

  /// What the even part explains beyond what the odd one does.
  Lack lack(double speed) const {
    Row x{};
    const double by_odd = explained(kColumns / 2, x), by_both = explained(kColumns, x);
    if (!(squares_ > 0) || !std::isfinite(by_both - by_odd)) return {};
    return {{x[3], x[4], x[5], speed}, (by_both - by_odd) / squares_};
  }

 private:
  static constexpr std::size_t kColumns = 6;  // odd: friction, that per drive, viscous; even: same
  using Row = std::array<double, kColumns>;

  /// The sum of squares that the first `count` columns explain, x being their coefficients.
  double explained(std::size_t count, Row& x) const {
    constexpr double kRidge = 1e-9;  // one level of the drive cannot tell the slope
    std::vector<double> matrix(count * count);
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < count; ++b)
        matrix[a * count + b] = matrix_[a * kColumns + b] * (a == b ? 1 + kRidge : 1);
    const std::span<double> found = std::span(x).first(count);
    if (!solve_positive_definite(matrix, std::span(right_).first(count), found)) return NAN;
    return std::inner_product(found.begin(), found.end(), right_.begin(), 0.0);
  }

  std::array<double, kColumns * kColumns> matrix_{};
  Row right_{};
  double squares_ = 0;
};

/// For valves of this speed.
Lack lack_at(const LawTask& task, const LawResiduals& residuals, std::span<const double> errors,
             double speed) {
  SideRegression regression;
  for (std::size_t r = 0; r < task.training.size(); ++r) {
    const auto [first, count] = residuals.segments()[r];
    const std::vector<DamperInput> inputs = damper_inputs(task.training[r], task.drive_unit);
    regression.add(errors.subspan(first, count), std::span(inputs).last(count), speed);
  }
  return regression.lack(speed);
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
  const bool asked = is_asked_for(apart);
  if (!alike.options.asymmetric && !asked) return false;
  if (status_of(best.solved) == FitReport::Status::Failed) return false;

  // Nothing to gain where the errors differ between the directions.
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
               format_number(std::sqrt(without / samples), 3) + " N";
  return true;
}

}  // namespace dashpot
