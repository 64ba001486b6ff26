#include "dashpot/identify/judge/stress.h"

#include <algorithm>
#include <cmath>

#include "dashpot/evaluate.h"

namespace dashpot {

bool StressRun::is_bounded() const { return finite && largest_share <= kStressSpans; }

StressRun stress(const DamperModel& model, const Domain& domain, double force_span) {
  constexpr double kSampleTime = 1e-3, kSwitching = 0.5;  // s
  const double middle = (domain.displacement_max + domain.displacement_min) / 2;
  const double stroke = kStressFactor * (domain.displacement_max - domain.displacement_min) / 2;
  const double speed = kStressFactor * std::max(domain.velocity_max, -domain.velocity_min);
  // Without a displacement any frequency serves.
  const double w = stroke > 0 ? speed / stroke : 2 * M_PI;

  // A sine, while the drive jumps between its ends.
  std::vector<DamperInput> inputs;
  std::vector<double> time;
  for (double t = 0; t < kStressSeconds; t = kSampleTime * static_cast<double>(time.size())) {
    const bool low = std::fmod(t, 2 * kSwitching) < kSwitching;
    inputs.push_back({middle + stroke * std::sin(w * t), speed * std::cos(w * t),
                      low ? domain.current_min : domain.current_max});
    time.push_back(t);
  }

  // Run it, and take the largest force.
  const FreeRun run = free_run(model, inputs, time);
  StressRun result{.seconds = kStressSeconds, .finite = !run.diverged_at};
  for (const double force : run.force)
    if (std::isfinite(force))
      result.largest_share = std::max(result.largest_share, std::abs(force) / force_span);
  return result;
}

}  // namespace dashpot
