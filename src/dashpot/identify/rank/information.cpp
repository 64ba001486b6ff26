#include "dashpot/identify/rank/information.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/damper/law.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/identify/fit/uncertainty.h"

namespace dashpot {
namespace {

/// The numbers that a fit chose: free coefficients, the force zero of each record in place of the
/// model's own, and the variance of the errors.
std::size_t chosen_numbers(const RankedModel& ranked, OffsetMode offset) {
  const auto is_bias = [&](const FittedParameter& p) {
    return std::ranges::any_of(find_law(ranked.name).params, [&](const ParamInfo& row) {
      return row.fit == Fit::Bias && row.name == p.name;
    });
  };
  std::size_t count = 1;
  if (offset == OffsetMode::Record) count += ranked.training.records.size();
  for (const FittedParameter& p : ranked.fit.parameters)
    if (!p.fixed && !(offset == OffsetMode::Record && is_bias(p))) ++count;
  return count;
}

}  // namespace

std::optional<FitLikelihood> likelihood_of(const RankedModel& ranked,
                                           const IdentifyOptions& options) {
  const bool has_prior = std::ranges::any_of(
      options.choices, [](const ParameterChoice& choice) { return choice.prior.has_value(); });
  if (!is_law(ranked.name) || has_prior || ranked.fit.status != FitReport::Status::Converged ||
      ranked.training.diverged > 0)
    return std::nullopt;

  // The scored residuals, one segment per record.
  FitLikelihood result{.parameters = chosen_numbers(ranked, options.offset)};
  std::vector<double> residuals;
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  for (const RecordResult& r : ranked.training.records) {
    const std::size_t first = residuals.size();
    for (std::size_t i = r.warm_up; i < r.measured.size(); ++i)
      residuals.push_back(r.measured[i] - r.modelled[i]);
    segments.emplace_back(first, residuals.size() - first);
  }
  for (const double e : residuals) result.squares += e * e;
  result.samples = residuals.size();
  result.correlation_length = correlation_length(residuals, segments);
  if (!(result.squares > 0) || !std::isfinite(result.squares)) return std::nullopt;
  return result;
}

std::vector<std::optional<InformationCriteria>> information_criteria(const Ranking& ranking) {
  // The law that fits best says how far apart independent samples are.
  const FitLikelihood* best = nullptr;
  for (const RankedModel& model : ranking.models)
    if (model.likelihood && (!best || model.likelihood->squares < best->squares))
      best = &*model.likelihood;

  std::vector<std::optional<InformationCriteria>> all(ranking.models.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::optional<FitLikelihood>& of = ranking.models[k].likelihood;
    if (!of) continue;
    const auto samples = static_cast<double>(of->samples),
               parameters = static_cast<double>(of->parameters);
    InformationCriteria& result = all[k].emplace();
    result.independent = samples / best->correlation_length;
    result.log_likelihood =
        -result.independent / 2 * (std::log(2 * std::numbers::pi * of->squares / samples) + 1);
    result.aic = 2 * parameters - 2 * result.log_likelihood;
    result.bic = std::log(result.independent) * parameters - 2 * result.log_likelihood;
  }
  return all;
}

}  // namespace dashpot
