#include "dashpot/damper/inverse/wanted.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/random_signal.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

/// Makes as many samples as the options ask for, x and v from at(t).
template <class At>
Motion sampled(const MotionOptions& options, At at) {
  constexpr double kMostSamples = 1e7;
  const auto& [amplitude, frequency, duration, sample_time, seed] = options;
  for (const double value : {amplitude, frequency, duration, sample_time})
    if (!(value > 0 && std::isfinite(value)))
      throw Error("motion", "amplitude, frequency, duration and sample time must be above 0");

  const double samples = std::floor(duration / sample_time) + 1;
  if (!(samples <= kMostSamples))
    throw Error(
        "motion", "it would have " + format_number(samples) + " samples",
        "at most " + format_number(kMostSamples) + ": a shorter one or a lower sample rate");

  Motion motion;
  motion.sample_time = sample_time;
  for (double k = 0; k < samples; ++k) {
    const auto [x, v] = at(k * sample_time);
    motion.displacement.push_back(x);
    motion.velocity.push_back(v);
  }
  return motion;
}

/// The damper's force along the motion with the current held, N, one per sample.
std::vector<double> force_at_held_current(const DamperModel& damper, const Motion& motion,
                                          double current) {
  const auto at = [&](std::size_t k) {
    return DamperInput{motion.displacement[k], motion.velocity[k], current};
  };
  std::vector<double> state(damper.state_size()), force;
  damper.rest(at(0), state);
  for (std::size_t k = 0; k < motion.size(); ++k) {
    if (k > 0) damper.advance(at(k - 1), at(k), motion.sample_time, state);
    force.push_back(damper.force(at(k), state));
  }
  return force;
}

}  // namespace

Motion sine_motion(const MotionOptions& options) {
  const double w = kTwoPi * options.frequency;
  Motion motion = sampled(options, [&](double t) {
    return std::pair{-options.amplitude * std::cos(w * t), options.amplitude * w * std::sin(w * t)};
  });
  motion.description = format_number(1000 * options.amplitude) + " mm at " +
                       format_number(options.frequency) + " Hz";
  return motion;
}

Motion random_motion(const MotionOptions& options) {
  Random random(options.seed);
  const RandomSignal signal(random, 0, options.frequency);
  const double sigma = options.amplitude / 2;
  Motion motion = sampled(options, [&](double t) {
    return std::pair{sigma * signal.at(t), sigma * signal.derivative(t)};
  });
  motion.description = "random motion, +-" + format_number(1000 * options.amplitude) +
                       " mm, 0 to " + format_number(options.frequency) + " Hz, seed " +
                       std::to_string(options.seed);
  return motion;
}

std::vector<double> admissible_force(const DamperModel& damper, const Motion& motion,
                                     const InverseLimits& limits, double band, std::uint64_t seed) {
  std::vector<double> force = force_at_held_current(damper, motion, limits.current_min);
  const std::vector<double> full = force_at_held_current(damper, motion, limits.current_max);
  Random random(seed);
  const RandomSignal signal(random, 0, band);
  for (std::size_t k = 0; k < force.size(); ++k) {
    const double share = 0.5 + 0.25 * signal.at(static_cast<double>(k) * motion.sample_time);
    force[k] += std::clamp(share, 0.0, 1.0) * (full[k] - force[k]);
  }
  return force;
}

std::vector<double> sine_force(double amplitude, double frequency, const Motion& motion) {
  std::vector<double> force;
  for (std::size_t k = 0; k < motion.size(); ++k)
    force.push_back(amplitude *
                    std::sin(kTwoPi * frequency * static_cast<double>(k) * motion.sample_time));
  return force;
}

}  // namespace dashpot
