#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "dashpot/base/text.h"
#include "dashpot/damper/law_side.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/law_task.h"
#include "dashpot/identify/fit/uncertainty.h"
#include "dashpot/model_file.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/global_search.h"

namespace dashpot {
namespace {

/// solver_options() that also tell of the parameters as they move.
LeastSquaresOptions watched_options(const LawTask& task, int iterations, double tolerance) {
  LeastSquaresOptions solver = solver_options(task.options, iterations, tolerance);
  if (!task.options.on_parameters) return solver;
  solver.on_iteration = [&task](int, double cost, std::span<const double> x) {
    task.options.monitor.report_cost(cost);
    std::vector<std::pair<std::string, double>> parameters;
    for (const LawUnknowns::Coefficient& c : task.unknowns.coefficients(x))
      parameters.emplace_back(c.name, c.value);
    task.options.on_parameters(task.options.monitor.stage, parameters);
  };
  return solver;
}

/// The best point that a global search finds within some times the expected size of each unknown.
std::vector<double> searched_start(const LawTask& task, const LeastSquaresProblem& problem) {
  constexpr double kWidest = 5;

  // Search within some times the expected size, on the start's side of 0.
  std::vector<double> start = task.unknowns.start(), lower = problem.lower, upper = problem.upper;
  for (std::size_t k = 0; k < start.size(); ++k) {
    lower[k] = std::max(lower[k], start[k] > 0 ? std::min(0.0, start[k]) : start[k] - kWidest);
    upper[k] = std::min(upper[k], start[k] < 0 ? std::max(0.0, start[k]) : start[k] + kWidest);
  }

  // The cost is the sum of squares; a point where a record diverges costs infinitely much.
  std::vector<double> residuals(problem.residuals);
  const auto cost = [&](std::span<const double> x) {
    task.options.monitor.check();
    if (!problem.residual(x, residuals)) return static_cast<double>(INFINITY);
    return std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
  };
  return global_search(cost, {lower, upper}, std::move(start), task.options.search,
                       task.options.seed);
}

/// The model that the fit of this task starts from first; null where none of this law is named.
const LawModel* stated_start(const LawTask& task) {
  for (const auto& model : task.options.from)
    if (const LawModel* start = model->law_inside(); start && start->law().name == task.law.name)
      return start;
  return nullptr;
}

/// The most promising end of short fits to a part of the data, from the starts given or, where
/// there are none, from several.
std::vector<double> best_start(const LawTask& task, std::vector<std::vector<double>> starts = {}) {
  constexpr double kTolerance = 1e-2, kHopeless = 2;
  constexpr int kIterations = 15, kHopelessAfter = 5;

  // A part of the data is enough to tell good starts from bad ones.
  const LawResiduals residuals = task.residuals(task.trial_thinning());
  const LeastSquaresProblem problem = residuals.problem(0, task.options.threads);

  // The starts: a model of the user's, the expected sizes, what a global search finds, and random
  // ones. A single start is the user's alone.
  if (starts.empty()) {
    Random random(task.options.seed);
    const LawModel* stated = stated_start(task);
    if (stated) starts.push_back(task.unknowns.of(*stated));
    if (stated && task.options.starts == 1 && task.options.search == 0) return starts.front();
    if (!stated || task.options.starts > 1) starts.push_back(task.unknowns.start());
    if (task.options.search > 0) starts.push_back(searched_start(task, problem));
    while (starts.size() < static_cast<std::size_t>(task.options.starts))
      starts.push_back(task.unknowns.start(&random));
  }

  // A short fit from each; once one has succeeded, a hopeless one is given up early.
  std::vector<double> best = starts.front();
  double best_cost = INFINITY;
  const auto attempt = [&](const std::vector<double>& start) {
    LeastSquaresOptions solver = watched_options(task, kIterations, kTolerance);
    if (std::isfinite(best_cost)) {
      solver.hopeless_after = kHopelessAfter;
      solver.hopeless_cost = kHopeless * best_cost;
    }
    const LeastSquaresReport tried = solve(problem, start, solver);
    if (!std::isfinite(tried.cost) || tried.cost >= best_cost) return;
    best_cost = tried.cost;
    best = tried.x;
  };
  for (const std::vector<double>& start : starts) attempt(start);
  return best;
}

Noise noise_at(const LawTask& task, const LawResiduals& residuals, std::span<const double> x) {
  std::vector<double> errors(residuals.size());
  if (!residuals.evaluate(x, errors)) return {};
  double squares = 0;
  for (const double error : errors) squares += error * error;
  const std::size_t used =
      std::min(residuals.size() - 1, task.unknowns.size() + task.training.size());
  const double length = correlation_length(errors, residuals.segments());
  return {std::sqrt(squares / static_cast<double>(residuals.size())),
          independent_variances(errors, residuals.segments(), used),
          std::sqrt(length * squares / static_cast<double>(residuals.size() - used))};
}

/// The end of a fit, with those unknowns moved off their bounds that nothing holds there: by the
/// slope of the cost, moving back would hardly change it.
std::vector<double> off_slack_bounds(const LawTask& task, const LeastSquaresReport& end) {
  constexpr double kSlack = 1e-3;
  std::vector<double> x = task.unknowns.off_bounds(end.x);
  for (std::size_t k = 0; k < end.gradient.size(); ++k)
    if (std::abs(end.gradient[k] * (x[k] - end.x[k])) > kSlack * end.cost) x[k] = end.x[k];
  return x;
}

/// Fits all data from x on. An early step too long may have thrown an unknown against a bound where
/// nothing pulls it back: such unknowns get one more chance from inside.
LeastSquaresReport solve_twice(const LawTask& task, const LeastSquaresProblem& problem,
                               std::vector<double> x) {
  constexpr int kIterations = 100, kSecondIterations = 20, kHopelessAfter = 3;
  constexpr double kTolerance = 1e-6, kHopeless = 1.02;

  // The first fit runs to the end.
  LeastSquaresOptions solver = watched_options(task, kIterations, kTolerance);
  LeastSquaresReport first = solve(problem, std::move(x), solver);

  // Move the unknowns that nothing holds at a bound back inside; done where there are none.
  const std::vector<double> freed = off_slack_bounds(task, first);
  if (freed == first.x || !std::isfinite(first.cost)) return first;

  // The second fit from there is short, and is kept only when it is better.
  solver.max_iterations = kSecondIterations;
  solver.hopeless_after = kHopelessAfter;
  solver.hopeless_cost = kHopeless * first.cost;
  const LeastSquaresReport second = solve(problem, freed, solver);
  if (second.cost >= first.cost) return first;
  return second.converged
             ? second
             : solve(problem, second.x, watched_options(task, kIterations, kTolerance));
}

/// The parameters that must not fall over the drive (Fit::Rises), and do at the end of this fit.
std::vector<std::string> falling(const LawTask& task, const LawSolution& fit) {
  std::vector<std::string> names;
  const Dependence fitted = fit.unknowns.model(fit.solved.x).parameters();
  const DriveRange drive = data_scale(task.training, task.drive_unit).drive;
  for (std::size_t p = 0; p < task.law.params.size(); ++p) {
    const ParamInfo& row = task.law.params[p];
    const Fit role = with_choice(row, choice_for(task.options.choices, task.model, row)).fit;
    if (role == Fit::Rises && fitted.at(p, drive.high) < fitted.at(p, drive.low))
      names.emplace_back(row.name);
  }
  return names;
}

/// The options with which these parameters are constant.
IdentifyOptions holding_constant(IdentifyOptions options, std::string_view model,
                                 const std::vector<std::string>& parameters) {
  for (const std::string& name : parameters)
    options.choices.push_back(
        {.law = std::string(model), .parameter = name, .form = Form::Constant});
  return options;
}

/// The fit of a task in which `names` are constant, from the end of `free`, in which they fall. A
/// damping in series that is all but rigid has hardly any effect, so that the data may have it fall
/// as they like; where it comes near nothing, beyond the data, it takes the force with it.
LawSolution held_steady(const LawTask& task, const LawSolution& free,
                        const std::vector<std::string>& names) {
  if (names.empty() || status_of(free.solved) == FitReport::Status::Failed) return free;
  LawSolution steady = solve_all(task, task.unknowns.of(free.unknowns.model(free.solved.x)));
  steady.steadied =
      join(names, " and ") + " would fall over the drive, and " +
      (names.size() == 1 ? "is" : "are") + " constant instead: the training RMSE is " +
      format_number(steady.noise.rms, 3) + " N in place of " + format_number(free.noise.rms, 3) +
      " N (--form " + names.front() + "=linear keeps that fit)";
  return steady;
}

/// Whether the law's filter may be slowed: it has one, and the user has not set its rate.
bool may_slow_filter(const LawTask& task, std::string_view model) {
  if (!task.law.fastest_rate) return false;
  const ParamInfo& rate = task.law.params[task.law.rate_parameter];
  return !choice_for(task.options.choices, model, rate).fixed;
}

/// A fit that feeds energy in is made again from its end, its filter no quicker than the law's
/// dissipative set allows; where that set is only a guess, slower until the measured verdict holds.
LawSolution dissipating(LawTask task, LawSolution active) {
  if (status_of(active.solved) == FitReport::Status::Failed) return active;

  // What dissipates as it fits best stays as it is.
  const Domain domain = domain_of(task.training, task.drive_unit);
  const auto verdict = [&](const LawSolution& fit) {
    return dissipation(fit.unknowns.model(fit.solved.x), domain, task.options.threads);
  };
  const Dissipation before = verdict(active);
  if (before.dissipates()) return active;

  // From its end, or from the usual start where that end is a corner without a way out: a sign that
  // is all but sharp allows no rate at all. The first fit that passes is taken; where none does,
  // the model is flagged as what it is.
  for (const std::vector<double>& start : {active.solved.x, task.unknowns.start()})
    for (const double share : {1.0, 0.5, 0.25, 0.125}) {
      task.unknowns.slow_filter(share);
      LawSolution slowed = solve_all(task, best_start(task, {start}));
      if (status_of(slowed.solved) == FitReport::Status::Failed || !verdict(slowed).dissipates())
        continue;
      slowed.steadied = active.steadied;
      slowed.sides = active.sides;
      slowed.restriction = "its filter is slowed to dissipate: as it fits best, " +
                           activity(before, task.drive_unit) + "; the training RMSE is " +
                           format_number(slowed.noise.rms, 3) + " N in place of " +
                           format_number(active.noise.rms, 3) +
                           " N (--allow-active keeps that fit)";
      return slowed;
    }
  return active;
}

/// Of the coefficients, in their order, row by row.
std::vector<double> coefficient_covariance(
    const std::vector<LawUnknowns::Coefficient>& coefficients, const Covariance& covariance) {
  const std::size_t count = coefficients.size();
  std::vector<double> matrix(count * count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      matrix[i * count + j] = matrix[j * count + i] =
          covariance.between(coefficients[i].first, coefficients[i].weights, coefficients[j].first,
                             coefficients[j].weights);
  return matrix;
}

std::vector<FittedParameter> fitted_parameters(
    const std::vector<LawUnknowns::Coefficient>& coefficients, const Covariance& covariance) {
  std::vector<FittedParameter> parameters;
  for (const auto& c : coefficients) {
    FittedParameter p{.name = c.name, .unit = c.unit, .meaning = c.meaning, .value = c.value};
    p.fixed = c.weights.empty();
    p.at_bound = c.at_bound;

    // The 95 % interval; a fixed coefficient has none.
    const double spread =
        p.fixed ? 0 : kNormal95 * std::sqrt(covariance.variance(c.first, c.weights));
    p.low = c.value - spread;
    p.high = c.value + spread;

    // It is weak when it depends on an unknown without effect or on one that can be traded.
    const auto touches = [&](std::size_t unknown) {
      return unknown >= c.first && unknown < c.first + c.weights.size();
    };
    p.weak =
        std::any_of(covariance.without_effect.begin(), covariance.without_effect.end(), touches);
    for (const auto& group : covariance.confounded)
      p.weak |= std::any_of(group.begin(), group.end(), touches);
    parameters.push_back(std::move(p));
  }
  return parameters;
}

/// Names of the coefficients that depend on these unknowns, each once.
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
    warnings.push_back(join(names_of(group, coefficients), " and ") +
                       " cannot be told apart on these data");
  return warnings;
}

}  // namespace

Thinning LawTask::trial_thinning() const {
  constexpr double kEnoughSamples = 8000, kLeastShare = 0.2;
  double samples = 0;
  for (const Record& record : training) samples += static_cast<double>(record.size());
  if (law.states.empty() && !unknowns.fits_lag())
    return {.stride = static_cast<std::size_t>(std::max(1.0, samples / kEnoughSamples))};
  return {.share = std::clamp(kEnoughSamples / samples, kLeastShare, 1.0)};
}

LawSolution solve_all(const LawTask& task, std::vector<double> x) {
  constexpr int kRounds = 4;
  constexpr double kSameNoise = 0.02;

  // The first noise is that at the start, and only priors need it.
  const LawResiduals residuals = task.residuals({});
  LawSolution end{task.unknowns, {}, {}, {}, {}, {}};
  if (!task.unknowns.priors().empty()) end.noise = noise_at(task, residuals, x);

  // Fit with the noise assumed, measure it again, and stop once the two agree.
  for (int round = 0; round < kRounds; ++round) {
    const double assumed = end.noise.independent;
    end.solved = solve_twice(task, residuals.problem(assumed, task.options.threads), std::move(x));
    end.noise = noise_at(task, residuals, end.solved.x);
    if (assumed == 0 || std::abs(end.noise.independent - assumed) <= kSameNoise * assumed) break;
    x = end.solved.x;
  }
  return end;
}

LeastSquaresOptions solver_options(const IdentifyOptions& options, int iterations,
                                   double tolerance) {
  LeastSquaresOptions solver;
  solver.max_iterations = iterations;
  solver.function_tolerance = tolerance;
  solver.threads = options.threads;
  solver.on_iteration = [&options](int, double cost, std::span<const double>) {
    options.monitor.report_cost(cost);
  };
  return solver;
}

FitReport::Status status_of(const LeastSquaresReport& solved) {
  if (solved.x.empty() || !std::isfinite(solved.cost)) return FitReport::Status::Failed;
  return solved.converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
}

LawSolution solve_law(const Law& law, const std::vector<Record>& training, DriveUnit drive_unit,
                      const IdentifyOptions& options, std::string_view model) {
  if (model.empty()) model = law.name;
  const LawTask free(law, training, drive_unit, options, model);
  LawSolution best = solve_all(free, best_start(free));

  // What must not fall over the drive is constant where it would.
  const std::vector<std::string> fallen = falling(free, best);
  const IdentifyOptions steady = holding_constant(options, model, fallen);
  const LawTask alike(law, training, drive_unit, steady, model);
  best = held_steady(alike, best, fallen);

  // Both sides alike, unless the user wants them apart and the data agree.
  const LawTask apart(with_side(law), training, drive_unit, steady, model);
  const bool differs = take_side_apart(alike, apart, best);
  const LawTask& task = differs ? apart : alike;
  if (options.allow_active || !may_slow_filter(task, model)) return best;
  return dissipating(task, std::move(best));
}

FitReport fit_law(const Law& law, const std::vector<Record>& training, DriveUnit drive_unit,
                  const IdentifyOptions& options) {
  const auto [unknowns, solved, noise, steadied, sides, restriction] =
      solve_law(law, training, drive_unit, options);
  FitReport report;
  report.status = status_of(solved);
  report.message = solved.message;
  report.iterations = solved.iterations;
  if (report.status == FitReport::Status::Failed) return report;

  report.model = std::make_shared<LawModel>(unknowns.model(solved.x));
  report.training_rmse = noise.rms;
  std::vector<double> variances = noise.variances;
  if (!unknowns.priors().empty()) variances.push_back(noise.independent * noise.independent);
  const Covariance spread = covariance(solved.part_matrices, variances, unknowns.size());
  const auto coefficients = unknowns.coefficients(solved.x);
  report.parameters = fitted_parameters(coefficients, spread);
  report.covariance = coefficient_covariance(coefficients, spread);
  report.warnings = unknowns.warnings();
  for (const std::string& said : {steadied, sides, restriction})
    if (!said.empty()) report.warnings.push_back(said);
  for (std::string& warning : warnings_of(coefficients, spread))
    report.warnings.push_back(std::move(warning));
  return report;
}

}  // namespace dashpot
