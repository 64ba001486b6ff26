#include <algorithm>
#include <cmath>
#include <vector>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/probe_sine.h"
#include "dashpot/model_file.h"

namespace dashpot {
namespace {

constexpr double kTolerance = 1e-3;  // of the energy that passes through
constexpr int kMostCycles = 12;      // until two are alike

/// A motion once it repeats itself: a cycle that is like the one before, else the mean of many, as
/// of a model whose own steps beat with the motion.
ProbedCycle settled(const DamperModel& model, const ProbeSine& sine) {
  constexpr double kAlike = 1e-3;  // of what passes through
  const std::vector<DamperInput> inputs = cycle_of(sine);
  const double step = step_of(sine);
  std::vector<double> state(model.state_size()), force(inputs.size());
  model.rest(inputs.front(), state);

  ProbedCycle sum, before;
  for (int n = 0; n < kMostCycles; ++n) {
    const std::size_t usable = model.run(inputs, {.step = step}, state, {force.data()});
    if (usable < inputs.size() || !std::isfinite(force.back())) return {.diverged = true};
    const ProbedCycle cycle = measured(inputs, force, step);
    const bool is_alike = n > 1 && std::abs(cycle.work - before.work) <= kAlike * cycle.passed;
    if (state.empty() || is_alike) return cycle;
    before = cycle;
    if (n < kMostCycles / 2) continue;
    sum.work += cycle.work;
    sum.passed += cycle.passed;
    sum.squares += cycle.squares;
  }
  return sum;
}

}  // namespace

bool Dissipation::dissipates() const { return !is_tested || share >= -kTolerance; }

Dissipation dissipation(const DamperModel& model, const Domain& domain, int threads) {
  const std::vector<ProbeSine> motions = probe_sines(domain, model.needs_displacement());
  std::vector<ProbedCycle> cycles(motions.size());
  parallel_for(motions.size(), threads,
               [&](std::size_t k) { cycles[k] = settled(model, motions[k]); });

  // The worst of them, and the band in which any is active.
  Dissipation result{.is_tested = true, .share = INFINITY};
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const ProbeSine& motion = motions[k];
    const double share = cycles[k].share();
    if (share < -kTolerance) {
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
  const std::string worst = " at " + format_number(result.frequency, 3) + " Hz, " +
                            format_number(1e3 * result.amplitude, 2) + " mm and " +
                            format_number(result.drive, 3) + " " + to_string(drive_unit);
  if (!std::isfinite(result.share)) return text + ": it diverges" + worst;
  return text + ":" + worst + " it acts as a dashpot of " + format_number(result.damping, 3) +
         " N*s/m";
}

}  // namespace dashpot
