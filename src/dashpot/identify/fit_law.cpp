#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/identify/fit.h"
#include "dashpot/identify/law_residuals.h"
#include "dashpot/identify/law_unknowns.h"
#include "dashpot/identify/uncertainty.h"

namespace dashpot {
namespace {

constexpr double kNormal95 = 1.959963984540054;  // two-sided 95 % point of the normal distribution

LeastSquaresOptions solver_options(const IdentifyOptions& options, int iterations, double tolerance) {
  LeastSquaresOptions solver;
  solver.max_iterations = iterations;
  solver.function_tolerance = tolerance;
  solver.threads = options.threads;
  solver.on_iteration = [&options](int, double) { options.monitor.check(); };
  return solver;
}

/// How much of each record the starts are tried on: all of small data, a fifth of large ones.
double trial_share(const std::vector<Record>& training) {
  constexpr double kEnoughSamples = 8000, kLeastShare = 0.2;
  double samples = 0;
  for (const Record& record : training) samples += static_cast<double>(record.size());
  return std::clamp(kEnoughSamples / samples, kLeastShare, 1.0);
}

/// Tries several starts on the first part of each record and returns the most promising end point.
std::vector<double> best_start(const LawUnknowns& unknowns, const std::vector<Record>& training,
                               const std::string& drive_unit, const IdentifyOptions& options) {
  constexpr double kTolerance = 1e-2;
  constexpr int kIterations = 15;
  const LawResiduals residuals(unknowns, training, drive_unit, options.offset, trial_share(training));
  const LeastSquaresProblem problem = residuals.problem();
  Random random(options.seed);
  std::vector<double> best = unknowns.start();
  double best_cost = INFINITY;
  for (int k = 0; k < std::max(1, options.starts); ++k) {
    const LeastSquaresReport tried = solve(problem, unknowns.start(k == 0 ? nullptr : &random),
                                           solver_options(options, kIterations, kTolerance));
    if (!tried.x.empty() && std::isfinite(tried.cost) && tried.cost < best_cost) {
      best_cost = tried.cost;
      best = tried.x;
    }
  }
  return best;
}

std::vector<FittedParameter> fitted_parameters(const std::vector<LawUnknowns::Coefficient>& coefficients,
                                               const Covariance& covariance) {
  std::vector<FittedParameter> parameters;
  for (const auto& c : coefficients) {
    FittedParameter p{.name = c.name, .unit = c.unit, .meaning = c.meaning, .value = c.value};
    p.fixed = c.weights.empty();
    p.at_bound = c.at_bound;
    const double spread = p.fixed ? 0 : kNormal95 * std::sqrt(covariance.variance(c.first, c.weights));
    p.low = c.value - spread;
    p.high = c.value + spread;
    const auto touches = [&](std::size_t unknown) {
      return unknown >= c.first && unknown < c.first + c.weights.size();
    };
    p.weak = std::any_of(covariance.without_effect.begin(), covariance.without_effect.end(), touches);
    for (const auto& group : covariance.confounded)
      p.weak |= std::any_of(group.begin(), group.end(), touches);
    parameters.push_back(std::move(p));
  }
  return parameters;
}

/// Names of the coefficients that hang on these unknowns, each once.
std::vector<std::string> names_of(const std::vector<std::size_t>& unknowns,
                                  const std::vector<LawUnknowns::Coefficient>& coefficients) {
  std::vector<std::string> names;
  for (const auto& c : coefficients)
    for (const std::size_t u : unknowns)
      if (u >= c.first && u < c.first + c.weights.size()) {
        names.push_back(c.name);
        break;
      }
  return names;
}

std::vector<std::string> warnings_of(const std::vector<LawUnknowns::Coefficient>& coefficients,
                                     const Covariance& covariance) {
  std::vector<std::string> warnings;
  for (const auto& c : coefficients)
    if (c.at_bound)
      warnings.push_back(c.name + " = " + format_number(c.value) + " " + c.unit +
                         " stands at a bound of its range");
  if (const auto names = names_of(covariance.without_effect, coefficients); !names.empty())
    warnings.push_back(join(names, ", ") + (names.size() == 1 ? " has" : " have") +
                       " no effect on these data");
  for (const auto& group : covariance.confounded)
    warnings.push_back(join(names_of(group, coefficients), " and ") + " cannot be told apart on these data");
  return warnings;
}

FitReport::Status status_of(const LeastSquaresReport& solved) {
  if (solved.x.empty() || !std::isfinite(solved.cost)) return FitReport::Status::Failed;
  return solved.converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
}

}  // namespace

FitReport fit_law(const Law& law, const std::vector<Record>& training, const std::string& drive_unit,
                  const IdentifyOptions& options) {
  constexpr int kIterations = 100;
  constexpr double kTolerance = 1e-6;
  const DataScale scale = data_scale(training, drive_unit);
  const LawUnknowns unknowns(law, scale, drive_unit, options.offset);
  const LawResiduals residuals(unknowns, training, drive_unit, options.offset);
  const LeastSquaresReport solved =
      solve(residuals.problem(), best_start(unknowns, training, drive_unit, options),
            solver_options(options, kIterations, kTolerance));
  FitReport report;
  report.status = status_of(solved);
  report.message = solved.message;
  report.iterations = solved.iterations;
  if (report.status == FitReport::Status::Failed) return report;

  report.model = std::make_shared<LawModel>(unknowns.model(solved.x));
  report.training_rmse = std::sqrt(2 * solved.cost / static_cast<double>(residuals.size()));

  std::vector<double> errors(residuals.size());
  residuals.evaluate(solved.x, errors);
  const double correlation = correlation_length(errors, residuals.segments());
  const double freedom = static_cast<double>(
      residuals.size() - std::min(residuals.size() - 1, unknowns.size() + training.size()));
  const Covariance spread =
      covariance(solved.normal_matrix, unknowns.size(), correlation * 2 * solved.cost / freedom);
  const auto coefficients = unknowns.coefficients(solved.x);
  report.parameters = fitted_parameters(coefficients, spread);
  report.warnings = warnings_of(coefficients, spread);
  return report;
}

}  // namespace dashpot
