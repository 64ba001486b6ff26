#include "studies/recovery/recovery_study.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/identify.h"
#include "dashpot/numerics/distributions.h"

namespace dashpot {
namespace {

/// A parameter that is `value` without current and moderately larger, or where bounds ask for it
/// smaller, at one ampere.
std::vector<double> known_coefficients(const ParamInfo& param) {
  const double rise = 2 * param.value <= param.upper && 2 * param.value >= param.lower ? 1 : -1;
  const double v = param.value;

  // The value without current, then the coefficients of its dependence on current, A.
  switch (param.form) {
    case Form::Constant:
      return {v};
    case Form::Linear:
      return {v, 0.5 * rise * v};
    case Form::Quadratic:
      return {v, 0.7 * rise * v, -0.2 * rise * v};
    case Form::Cubic:
      return {v, 0.7 * rise * v, -0.3 * rise * v, 0.1 * rise * v};
    case Form::Exponential:
      return {v, (1 + 0.8 * rise) * v, 1.5};
  }
  return {v};
}

FitReport fit_once(const Law& law, const RecoveryStudyOptions& options, int repetition) {
  const Dataset data =
      run_virtual_bench(known_damper(law), DriveUnit::Ampere, recovery_bench(options, repetition));
  IdentifyOptions identification;
  identification.seed = options.seed;
  identification.threads = 1;
  identification.monitor.stop = options.monitor.stop;
  // A fit sets such scales by the size of the data; here they are known.
  for (const ParamInfo& param : law.params)
    if (param.fit == Fit::Scale)
      identification.choices.push_back(
          {.parameter = std::string(param.name), .fixed = param.value});
  return identify(std::string(law.name), data.records, DriveUnit::Ampere, identification);
}

/// Adds what the fits say of one coefficient.
void summarise(ParameterRecovery& row, const std::vector<const FittedParameter*>& found) {
  // Only fits that gave an interval count: coverage, errors and standard errors.
  double errors = 0, squares = 0, deviations = 0;
  for (const FittedParameter* p : found) {
    row.weak += p->weak;
    row.at_bound += p->at_bound && !p->weak;
    row.fixed |= p->fixed;
    if (p->weak || p->at_bound || p->fixed) continue;
    ++row.counted;
    row.inside += row.truth >= p->low && row.truth <= p->high;
    errors += p->value - row.truth;
    squares += (p->value - row.truth) * (p->value - row.truth);
    deviations += (p->high - p->low) / 2 / kNormal95;
  }

  // Bias and spread in units of the mean standard error that the fits state.
  if (row.counted < 2 || deviations <= 0) return;
  const double mean = errors / row.counted, deviation = deviations / row.counted;
  row.bias = mean / deviation;
  row.spread = std::sqrt(std::max(0.0, squares / row.counted - mean * mean)) / deviation;
}

LawRecovery judge(const Law& law, const std::vector<FitReport>& fits) {
  // Failures and time over all repetitions.
  const LawModel truth = known_damper(law);
  LawRecovery recovery{.law = std::string(law.name)};
  for (const FitReport& fit : fits) {
    recovery.failed += fit.status == FitReport::Status::Failed;
    recovery.seconds += fit.seconds / static_cast<double>(fits.size());
  }

  // Each coefficient that fits estimate, against the truth.
  for (std::size_t p = 0; p < law.params.size(); ++p) {
    if (law.params[p].fit == Fit::Bias || law.params[p].fit == Fit::Drive) continue;
    const Form form = truth.parameters().forms[p];
    for (std::size_t c = 0; c < coefficient_count(form); ++c) {
      ParameterRecovery row{
          .name = coefficient_name(law.params[p].name, form, c),
          .unit = coefficient_unit(law.params[p].unit, form, c, DriveUnit::Ampere),
          .truth = truth.parameters().coefficients[p][c]};

      // The same coefficient by its name in all fits.
      std::vector<const FittedParameter*> found;
      for (const FitReport& fit : fits)
        for (const FittedParameter& fitted : fit.parameters)
          if (fitted.name == row.name) found.push_back(&fitted);
      summarise(row, found);
      recovery.parameters.push_back(std::move(row));
    }
  }
  return recovery;
}

}  // namespace

int LawRecovery::counted() const {
  int sum = 0;
  for (const ParameterRecovery& p : parameters) sum += p.counted;
  return sum;
}

int LawRecovery::inside() const {
  int sum = 0;
  for (const ParameterRecovery& p : parameters) sum += p.inside;
  return sum;
}

double LawRecovery::share() const {
  return counted() == 0 ? NAN : static_cast<double>(inside()) / counted();
}

bool LawRecovery::enough() const {
  constexpr int kLeast = 100;  // of which 90 to 99 hold with odds of 98 in 100 (binomial)
  const double chance = std::sqrt(0.95 * 0.05 / counted());  // standard deviation of the share
  return counted() >= kLeast || share() < 0.95 - 3 * chance;
}

bool LawRecovery::trustworthy() const { return share() >= 0.90 && share() <= 0.99; }

LawModel known_damper(const Law& law) {
  Dependence dependence;
  for (const ParamInfo& param : law.params) {
    const bool estimated = param.fit == Fit::Free;
    dependence.forms.push_back(param.fit == Fit::Drive ? Form::Linear
                               : estimated             ? param.form
                                                       : Form::Constant);
    dependence.coefficients.push_back(param.fit == Fit::Drive ? std::vector<double>{0, 1}
                                      : estimated             ? known_coefficients(param)
                                                              : std::vector<double>{param.value});
  }
  return LawModel(law, std::move(dependence), DriveUnit::Ampere, 0);
}

BenchOptions recovery_bench(const RecoveryStudyOptions& options, int repetition) {
  BenchOptions bench;
  bench.motions = {{0.02, 0.5}, {0.012, 2}};
  bench.drive_levels = {0, 0.4, 0.8, 1.2};
  bench.cycles = 2;
  bench.sample_rate = 250;
  bench.force_noise = options.force_noise;
  if (!options.noisy_motion) {
    bench.velocity_sensor = true;
    bench.displacement_noise = bench.displacement_resolution = 0;
  }
  bench.seed = options.seed * 1'000'003 + static_cast<std::uint64_t>(repetition);
  return bench;
}

std::vector<LawRecovery> study_recovery(const RecoveryStudyOptions& options) {
  // The laws asked for, each once; all where none is named.
  std::vector<const Law*> studied;
  for (const std::string& name : options.laws)
    if (const Law* law = &find_law(name); std::ranges::find(studied, law) == studied.end())
      studied.push_back(law);
  if (studied.empty()) studied.assign(laws().begin(), laws().end());

  // Every repetition of every law is a task of its own.
  const auto repetitions = static_cast<std::size_t>(options.repetitions);
  const std::size_t tasks = studied.size() * repetitions;
  std::vector<std::vector<FitReport>> fits(studied.size(), std::vector<FitReport>(repetitions));
  std::atomic<std::size_t> done = 0;
  parallel_for(tasks, options.threads, [&](std::size_t task) {
    const std::size_t law = task / repetitions, repetition = task % repetitions;
    fits[law][repetition] = fit_once(*studied[law], options, static_cast<int>(repetition));
    options.monitor.report(std::string(studied[law]->name),
                           static_cast<double>(++done) / static_cast<double>(tasks));
  });

  // Judged law by law, over all repetitions.
  std::vector<LawRecovery> recoveries;
  for (std::size_t law = 0; law < studied.size(); ++law)
    recoveries.push_back(judge(*studied[law], fits[law]));
  return recoveries;
}

}  // namespace dashpot
