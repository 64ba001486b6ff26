#include "dashpot/identify/rank/mean_of_models.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/kinds/mean/mean_model.h"
#include "identify/small_campaign.h"
#include "support.h"

using namespace dashpot;

namespace {

const Dataset& three_motions() {
  static const Dataset dataset = small_campaign({{0.01, 1}, {0.005, 3}, {0.02, 0.5}});
  return dataset;
}

Ranking ranked_of_three(const std::vector<std::string>& models) {
  return rank(models, three_motions(), {.by = LeaveOut::By::Condition}, {});
}

const RankedModel& row_of_ranking(const Ranking& ranking, std::string_view name) {
  return *std::ranges::find(ranking.models, name, &RankedModel::name);
}

}  // namespace

TEST_CASE("a ranking's mean is judged by the means of its members' folds") {
  const Ranking ranking = ranked_of_three({"tanh_kwok", "bouc_wen", "bingham", "mean"});
  const RankedModel& mean = row_of_ranking(ranking, "mean");
  const auto& model = dynamic_cast<const MeanModel&>(*mean.fit.model);
  REQUIRE(model.members().size() >= 2);
  REQUIRE(is_recommendable(mean));
  CHECK(mean.title.starts_with("Mean of "));
  CHECK(mean.fold_fits.size() == ranking.folds.size());

  // Weights go by the reciprocal of what each leaves.
  double reciprocals = 0;
  for (const MeanModel::Member& member : model.members())
    reciprocals += 1 / row_of_ranking(ranking, member.model->name()).left_out.pooled.esr;
  for (const MeanModel::Member& member : model.members())
    CHECK_CLOSE(member.weight,
                1 / row_of_ranking(ranking, member.model->name()).left_out.pooled.esr / reciprocals,
                1e-12, 0);

  // Its errors on left-out records are the weighted ones of its members there.
  double worst = 0, span = 0;
  for (std::size_t r = 0; r < mean.left_out.records.size(); ++r) {
    const RecordResult& record = mean.left_out.records[r];
    for (std::size_t k = record.warm_up; k < record.measured.size(); ++k) {
      double modelled = 0;
      for (const MeanModel::Member& member : model.members())
        modelled += member.weight *
                    row_of_ranking(ranking, member.model->name()).left_out.records[r].modelled[k];
      worst = std::max(worst, std::abs(modelled - record.modelled[k]));
      span = std::max(span, std::abs(record.measured[k]));
    }
  }
  CHECK(worst < 1e-6 * span);

  // It stands where its error puts it.
  CHECK(std::ranges::is_sorted(ranking.models, {},
                               [](const RankedModel& one) { return one.left_out.pooled.esr; }));

  // What is saved is the same model.
  const ModelFile file = to_model_file(mean, three_motions(), "a test");
  const Evaluation again =
      evaluate(*file.model, three_motions().records, three_motions().drive_unit);
  CHECK_CLOSE(again.pooled.esr, mean.training.pooled.esr, 1e-6, 1e-9);
}

TEST_CASE("models whose errors make up for one another are better together") {
  // One record of a force that both models miss by as much, to either side.
  std::vector<RankedModel> models(2);
  for (std::size_t m = 0; m < 2; ++m) {
    models[m].name = m == 0 ? "bingham" : "tanh_kwok";
    models[m].fit.status = FitReport::Status::Converged;
    models[m].fit.model = ranked_of_three({models[m].name}).models.front().fit.model;
    RecordResult record;
    record.measured = {1, -1, 1, -1};
    record.modelled =
        m == 0 ? std::vector<double>{2, -1, 2, -1} : std::vector<double>{0, -1, 0, -1};
    models[m].left_out.records = {record};
    models[m].left_out.pooled.esr = 50;
  }
  const std::vector<MeanShare> shares = shares_of_mean(models);
  REQUIRE(shares.size() == 2);
  CHECK_CLOSE(shares[0].weight, 0.5, 1e-15, 0);
  RankedModel mean;
  make_mean(models, shares, mean);
  CHECK(mean.title == "Mean of bingham and tanh_kwok");
  CHECK(mean.fit.model->name() == "mean");
  CHECK(mean.fold_fits.empty());

  // One that may not be recommended is no member, and one alone has no mean.
  models[1].left_out.diverged = 1;
  CHECK(shares_of_mean(models).empty());
}

TEST_CASE("a mean of one model or none is refused before any fit") {
  CHECK(message_of([] {
          ranked_of_three({"mean", "bingham"});
        }).find("is made of the other models of a ranking") != std::string::npos);
}
