#include "dashpot/identify/rank/mean_of_models.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "dashpot/damper/kinds/mean/mean_model.h"

namespace dashpot {
namespace {

constexpr std::size_t kMostMembers = 4;  // members
constexpr double kLeastError = 1e-9;     // %, which is as good as none

/// The first `count` of these models, best first.
std::vector<MeanShare> weighted(const std::vector<RankedModel>& models,
                                const std::vector<std::size_t>& places, std::size_t count) {
  std::vector<MeanShare> shares;
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    shares.push_back({places[k], 1 / std::max(models[places[k]].left_out.pooled.esr, kLeastError)});
    sum += shares.back().weight;
  }
  for (MeanShare& share : shares) share.weight /= sum;
  return shares;
}

/// Sum over the left-out records of what their mean leaves squared, N^2. All models were judged on
/// the same records in the same order, each with the offset that it has there.
double squares_left(const std::vector<RankedModel>& models, const std::vector<MeanShare>& shares) {
  double squares = 0;
  const Evaluation& first = models[shares.front().model].left_out;
  for (std::size_t r = 0; r < first.records.size(); ++r) {
    const RecordResult& record = first.records[r];
    for (std::size_t k = record.warm_up; k < record.measured.size(); ++k) {
      double error = 0;
      for (const MeanShare& share : shares) {
        const RecordResult& own = models[share.model].left_out.records[r];
        error += share.weight * (own.measured[k] - own.modelled[k]);
      }
      squares += error * error;
    }
  }
  return squares;
}

/// The mean of these fits as a fit of its own; without a model where one of them has none.
FitReport mean_of_fits(const std::vector<const FitReport*>& fits,
                       const std::vector<MeanShare>& shares) {
  FitReport report;
  std::vector<MeanModel::Member> members;
  for (std::size_t m = 0; m < fits.size(); ++m) {
    if (!fits[m]->model) return report;
    members.push_back({fits[m]->model, shares[m].weight});

    // What a record has beyond the mean's bias is the mean of what it has beyond theirs.
    for (std::size_t r = 0; r < fits[m]->offsets.size(); ++r) {
      const auto& [record, offset] = fits[m]->offsets[r];
      if (m == 0) report.offsets.emplace_back(record, 0);
      report.offsets[r].second += shares[m].weight * offset;
    }
  }
  report.status = FitReport::Status::Converged;
  report.model = std::make_shared<MeanModel>(std::move(members));
  return report;
}

}  // namespace

std::vector<MeanShare> shares_of_mean(const std::vector<RankedModel>& models) {
  // Whoever may be a member, the least error first.
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < models.size(); ++k)
    if (is_recommendable(models[k]) && MeanModel::may_be_member(*models[k].fit.model))
      places.push_back(k);
  std::ranges::stable_sort(places, {},
                           [&](std::size_t k) { return models[k].left_out.pooled.esr; });

  // As many of them as leave the least together.
  std::vector<MeanShare> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t count = 2; count <= std::min(kMostMembers, places.size()); ++count) {
    std::vector<MeanShare> shares = weighted(models, places, count);
    const double squares = squares_left(models, shares);
    if (squares < least) least = squares, best = std::move(shares);
  }
  return best;
}

void make_mean(const std::vector<RankedModel>& models, const std::vector<MeanShare>& shares,
               RankedModel& mean) {
  // Its name by those of its members.
  mean.title = "Mean of ";
  for (std::size_t m = 0; m < shares.size(); ++m) {
    if (m > 0) mean.title += m + 1 < shares.size() ? ", " : " and ";
    mean.title += models[shares[m].model].name;
  }

  // Each of its fits by theirs.
  const auto mean_of = [&](const auto& fit_of) {
    std::vector<const FitReport*> fits;
    for (const MeanShare& share : shares) fits.push_back(&fit_of(models[share.model]));
    return mean_of_fits(fits, shares);
  };
  using Report = const FitReport&;
  mean.fit = mean_of([](const RankedModel& m) -> Report { return m.fit; });
  const RankedModel& first = models[shares.front().model];
  for (std::size_t f = 0; f < first.fold_fits.size(); ++f)
    mean.fold_fits.push_back(
        mean_of([f](const RankedModel& m) -> Report { return m.fold_fits[f]; }));
  for (std::size_t f = 0; f < first.held_back_fits.size(); ++f)
    mean.held_back_fits.push_back(
        mean_of([f](const RankedModel& m) -> Report { return m.held_back_fits[f]; }));
}

}  // namespace dashpot
