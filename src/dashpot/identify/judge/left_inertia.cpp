#include "dashpot/identify/judge/left_inertia.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace dashpot {
namespace {

/// Of samples from the warm-up on, by central differences; m/s^2.
std::vector<double> accelerations(const RecordResult& record, std::size_t first) {
  std::vector<double> a;
  for (std::size_t k = first; k + 1 < record.time.size(); ++k)
    a.push_back((record.velocity[k + 1] - record.velocity[k - 1]) /
                (record.time[k + 1] - record.time[k - 1]));
  return a;
}

void remove_mean(std::vector<double>& samples) {
  const double mean =
      std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
  for (double& sample : samples) sample -= mean;
}

}  // namespace

LeftInertia left_inertia(const Evaluation& evaluation) {
  double aa = 0, ae = 0, ee = 0;
  for (const RecordResult& record : evaluation.records) {
    const std::size_t first = std::max<std::size_t>(record.warm_up, 1);
    if (record.diverged_at || record.velocity.size() < first + 3) continue;

    // Acceleration and error, each about its mean over the record.
    std::vector<double> a = accelerations(record, first), e(a.size());
    for (std::size_t k = 0; k < e.size(); ++k)
      e[k] = record.measured[first + k] - record.modelled[first + k];
    remove_mean(a);
    remove_mean(e);

    for (std::size_t k = 0; k < a.size(); ++k) {
      aa += a[k] * a[k];
      ae += a[k] * e[k];
      ee += e[k] * e[k];
    }
  }
  if (!(aa > 0 && ee > 0)) return {};
  return {.mass = ae / aa, .share = ae * ae / (aa * ee)};
}

}  // namespace dashpot
