#include <algorithm>
#include <optional>

#include "dashpot/damper/registry.h"
#include "dashpot/identify/judge/left_inertia.h"
#include "dashpot/rank.h"
#include "dashpot/record/inertia.h"

namespace dashpot {
namespace {

/// Nothing where a record has no acceleration.
std::optional<Dataset> without_inertia(Dataset dataset, double mass) {
  for (Record& record : dataset.records)
    if (!take_off_inertia(record, mass)) return std::nullopt;
  return dataset;
}

/// Whether the same model leaves a tenth less squared error on left-out records, and less on most.
bool leaves_less(const Evaluation& after, const Evaluation& before) {
  constexpr double kLess = 0.1, kMost = 0.6;
  if (after.records.size() != before.records.size()) return false;
  double better = 0;
  for (std::size_t k = 0; k < after.records.size(); ++k)
    better += after.records[k].metrics.rmse < before.records[k].metrics.rmse;

  const double share = after.pooled.rmse / before.pooled.rmse;
  return share * share < 1 - kLess && better >= kMost * static_cast<double>(after.records.size());
}

/// The best model of a ranking that was fitted by itself, where there is one to judge by.
const RankedModel* best_of(const Ranking& ranking) {
  for (const RankedModel& model : ranking.models)
    if (model_info(model.name).kind != ModelKind::Mean)
      return is_recommendable(model) ? &model : nullptr;
  return nullptr;
}

}  // namespace

Ranking rank_without_inertia(const std::vector<std::string>& models, Dataset& dataset,
                             const LeaveOut& leave_out, const IdentifyOptions& options,
                             FitStore* store) {
  Ranking ranking = rank(models, dataset, leave_out, options, store);
  const RankedModel* const best = best_of(ranking);
  if (!best) return ranking;

  // A model takes a part of the inertia for its own, so that the rest shows only once that is gone.
  constexpr int kRounds = 4;
  FoundInertia found{0, best->name, best->left_out.pooled.rmse, 0};
  Evaluation errors = best->left_out;
  for (int round = 0; round < kRounds && left_inertia(errors).is_told(); ++round) {
    const double mass = left_inertia(errors).mass;
    std::optional<Dataset> freed = without_inertia(dataset, found.mass + mass);
    if (!freed) break;
    const Ranking again = rank({best->name}, *freed, leave_out, options, store);
    if (!best_of(again) || !leaves_less(again.models.front().left_out, errors)) break;
    errors = again.models.front().left_out;
    found.mass += mass;
    found.after = errors.pooled.rmse;
  }
  if (found.mass == 0) return ranking;

  // All models on forces that are freed of it.
  dataset = *without_inertia(std::move(dataset), found.mass);
  Ranking freed = rank(models, dataset, leave_out, options, store);
  freed.inertia = found;
  freed.kept_fits = ranking.kept_fits;
  freed.wall_seconds += ranking.wall_seconds;
  return freed;
}

}  // namespace dashpot
