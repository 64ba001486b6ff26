#include <algorithm>
#include <cmath>
#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/damper/probe_sine.h"
#include "dashpot/model_file.h"

namespace dashpot {

bool Dissipation::dissipates() const { return !is_tested || share >= -ProbedCycle::kTolerance; }

Dissipation dissipation(const DamperModel& model, const Domain& domain, int threads) {
  const std::vector<ProbeSine> motions = probe_sines(model, domain);
  const std::vector<ProbedCycle> cycles = settled_cycles(model, motions, threads);

  // The worst of them, and the band in which any is active.
  Dissipation result{.is_tested = true, .share = INFINITY};
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const ProbeSine& motion = motions[k];
    const double share = cycles[k].share();
    if (cycles[k].is_active()) {
      if (result.active_to == 0) result.active_from = motion.frequency;
      result.active_from = std::min(result.active_from, motion.frequency);
      result.active_to = std::max(result.active_to, motion.frequency);
    }
    if (share >= result.share) continue;
    result.frequency = motion.frequency;
    result.amplitude = motion.amplitude;
    result.position = motion.position;
    result.drive = motion.drive;
    result.damping = cycles[k].damping();
    result.share = share;
  }
  return result;
}

std::string activity(const Dissipation& result, DriveUnit drive_unit) {
  if (result.dissipates()) return "";
  std::string text = "it feeds energy into motions of " + format_number(result.active_from, 3);
  if (result.active_to > result.active_from) text += " to " + format_number(result.active_to, 3);
  text += " Hz";
  std::string worst = " at " + format_number(result.frequency, 3) + " Hz";
  worst += (drive_unit == DriveUnit::None ? " and " : ", ") +
           format_number(1e3 * result.amplitude, 2) + " mm";
  if (drive_unit != DriveUnit::None)
    worst += " and " + format_number(result.drive, 3) + " " + to_string(drive_unit);
  if (!std::isfinite(result.share)) return text + ": it diverges" + worst;
  return text + ":" + worst + " it acts as a dashpot of " + format_number(result.damping, 3) +
         " N*s/m";
}

}  // namespace dashpot
