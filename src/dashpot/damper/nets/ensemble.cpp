#include "dashpot/damper/nets/ensemble.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "dashpot/base/parallel.h"

namespace dashpot {

std::vector<TrainedMlp> train_from_starts(
    const Mlp& mlp, std::size_t count, std::uint64_t seed, int threads,
    const std::function<TrainReport(Mlp& mlp, std::size_t k)>& train_one) {
  std::vector<TrainedMlp> trained(count, {mlp, {}});
  parallel_for(count, threads, [&](std::size_t k) {
    initialise(trained[k].mlp, seed + k);
    trained[k].report = train_one(trained[k].mlp, k);
  });
  return trained;
}

TrainedMlp& best_of(std::span<TrainedMlp> trained) {
  assert(!trained.empty());
  const auto error = [](const TrainedMlp& one) {
    const double rmse = one.report.left_out_rmse > 0 ? one.report.left_out_rmse : one.report.rmse;
    return std::isfinite(rmse) ? rmse : INFINITY;
  };
  return *std::min_element(
      trained.begin(), trained.end(),
      [&](const TrainedMlp& a, const TrainedMlp& b) { return error(a) < error(b); });
}

MlpEnsemble::MlpEnsemble(const std::vector<Mlp>& members) {
  members_.reserve(members.size());
  for (const Mlp& member : members) members_.emplace_back(member);
}

MlpEnsemble::Answer MlpEnsemble::evaluate(const double* input) const noexcept {
  // Welford's recurrence
  Answer answer;
  double squares = 0, count = 0;
  for (const MlpEvaluator<double>& member : members_) {
    const double value = member.evaluate(input), before = answer.mean;
    answer.mean += (value - before) / ++count;
    squares += (value - before) * (value - answer.mean);
  }
  if (count > 1) answer.spread = std::sqrt(squares / (count - 1));
  return answer;
}

}  // namespace dashpot
