#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/model_file.h"

namespace dashpot {
namespace {

constexpr std::array kFrequencies{1.0,  3.0,  8.0,  14.0,  20.0,  28.0,
                                  40.0, 55.0, 75.0, 100.0, 140.0, 200.0};  // Hz
constexpr std::array kSmallAmplitudes{1e-7, 2e-6};  // m; a car may swing on with a few um
constexpr double kLeastAmplitude = 1e-5;            // m, of those up to the data's
constexpr std::size_t kAmplitudes = 4, kDrives = 5;
constexpr double kTolerance = 1e-3;    // of the energy that passes through
constexpr std::size_t kSamples = 100;  // of a cycle
constexpr int kMostCycles = 12;        // until two are alike

/// A sine about a position, at one drive.
struct Motion {
  double frequency, amplitude, position, drive;
};

/// What cycles of a motion did.
struct Cycles {
  double work = 0, passed = 0;  ///< J; out, and through in both directions
  double squares = 0;           ///< m^2/s: of the velocity, over time
  bool diverged = false;

  double share() const {
    if (diverged) return -INFINITY;
    return passed > 0 ? work / passed : 0;
  }
  double damping() const { return work / squares; }
};

/// One cycle of a motion, its first sample again at its end; none falls on the middle of the
/// stroke, where a law may leap.
std::vector<DamperInput> cycle_of(const Motion& motion) {
  std::vector<DamperInput> inputs;
  const double w = 2 * std::numbers::pi * motion.frequency;
  for (std::size_t k = 0; k <= kSamples; ++k) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.5) / kSamples;
    inputs.push_back({motion.position + motion.amplitude * std::sin(angle),
                      motion.amplitude * w * std::cos(angle), motion.drive});
  }
  return inputs;
}

/// One cycle. Its work by the trapezoid rule, which is exact for a spring; what passes through is
/// that of the force about its mean, so that a preload is no energy.
Cycles measured(const std::vector<DamperInput>& inputs, const std::vector<double>& force,
                double step) {
  double mean = 0;
  for (std::size_t k = 0; k < kSamples; ++k) mean += force[k] / kSamples;

  Cycles cycle;
  for (std::size_t k = 0; k < kSamples; ++k) {
    const double way = inputs[k + 1].displacement - inputs[k].displacement;
    const double work = ((force[k] + force[k + 1]) / 2 - mean) * way;
    cycle.work += work;
    cycle.passed += std::abs(work);
    cycle.squares += inputs[k].velocity * inputs[k].velocity * step;
  }
  return cycle;
}

/// A motion once it repeats itself: a cycle that is like the one before, else the mean of many, as
/// of a model whose own steps beat with the motion.
Cycles settled(const DamperModel& model, const Motion& motion) {
  constexpr double kAlike = 1e-3;  // of what passes through
  const std::vector<DamperInput> inputs = cycle_of(motion);
  const double step = 1 / (motion.frequency * kSamples);
  std::vector<double> state(model.state_size()), force(inputs.size());
  model.rest(inputs.front(), state);

  Cycles sum, before;
  for (int n = 0; n < kMostCycles; ++n) {
    const std::size_t usable = model.run(inputs, {.step = step}, state, {force.data()});
    if (usable < inputs.size() || !std::isfinite(force.back())) return {.diverged = true};
    const Cycles cycle = measured(inputs, force, step);
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

/// Numbers from `low` to `high`, evenly or by equal ratios; one where there is nothing between.
std::vector<double> spaced(double low, double high, std::size_t count, bool by_ratio) {
  if (!(high > low)) return {low};
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(count - 1);
    values.push_back(by_ratio ? low * std::pow(high / low, share) : low + (high - low) * share);
  }
  return values;
}

/// Sines within the domain. Small ones are made about three positions where position matters.
std::vector<Motion> motions_within(const DamperModel& model, Domain domain) {
  if (!(domain.velocity_max > domain.velocity_min))
    domain = usual_domain(domain.current_min, domain.current_max);
  const double middle = (domain.displacement_max + domain.displacement_min) / 2;
  const double speed = std::max(domain.velocity_max, -domain.velocity_min);
  double stroke = (domain.displacement_max - domain.displacement_min) / 2;
  if (!(stroke > 0)) stroke = usual_domain(0, 0).displacement_max;

  std::vector<Motion> motions;
  for (const double drive : spaced(domain.current_min, domain.current_max, kDrives, false))
    for (const double frequency : kFrequencies) {
      const double most = std::min(stroke, speed / (2 * std::numbers::pi * frequency));
      std::vector<double> amplitudes = spaced(kLeastAmplitude, most, kAmplitudes, true);
      amplitudes.insert(amplitudes.begin(), kSmallAmplitudes.begin(), kSmallAmplitudes.end());
      for (const double amplitude : amplitudes) {
        motions.push_back({frequency, amplitude, middle, drive});
        if (!model.needs_displacement() || amplitude < kLeastAmplitude || amplitude > stroke / 10)
          continue;
        for (const double side : {-0.7, 0.7})
          motions.push_back({frequency, amplitude, middle + side * stroke, drive});
      }
    }
  return motions;
}

}  // namespace

bool Dissipation::dissipates() const { return !is_tested || share >= -kTolerance; }

Dissipation dissipation(const DamperModel& model, const Domain& domain, int threads) {
  const std::vector<Motion> motions = motions_within(model, domain);
  std::vector<Cycles> cycles(motions.size());
  parallel_for(motions.size(), threads,
               [&](std::size_t k) { cycles[k] = settled(model, motions[k]); });

  // The worst of them, and the band in which any is active.
  Dissipation result{.is_tested = true, .share = INFINITY};
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const Motion& motion = motions[k];
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
