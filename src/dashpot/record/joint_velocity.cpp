#include "dashpot/record/joint_velocity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/numerics/filter.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/numerics/root_mean_square.h"
#include "dashpot/numerics/spectrum.h"
#include "dashpot/record/differentiate.h"

namespace dashpot {
namespace {

// By how much more than independent ones the squares of lines under a window scatter.
constexpr double kOfWindow = 2;

/// What slope_of() makes of noise at this phase from sample to sample, 1/s^2.
double slope_gain(double phase, double dt) {
  const double gain = 3 * std::sin(phase) / (dt * (2 + std::cos(phase)));
  return gain * gain;
}

/// Takes off what goes with the displacement, its slope or that one's.
void take_off_motion(std::span<const double> x, double dt, std::vector<double>& difference) {
  constexpr std::size_t kCount = 4;
  constexpr double kApart = 1e-12;  // on the diagonal, where two of them say the same
  const std::vector<double> velocity = smooth_derivative(x, dt).slope;
  const std::vector<double> acceleration = slope_of(velocity, dt);
  const auto function = [&](std::size_t which, std::size_t k) {
    const double values[kCount] = {1, x[k], velocity[k], acceleration[k]};
    return values[which];
  };

  // Least squares, each function over its own size.
  std::vector<double> size(kCount), matrix(kCount * kCount), right(kCount), share(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    for (std::size_t k = 0; k < x.size(); ++k) size[i] += std::pow(function(i, k), 2);
    size[i] = std::sqrt(size[i]);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    for (std::size_t k = 0; k < x.size(); ++k) right[i] += function(i, k) * difference[k];
    right[i] /= size[i];
    for (std::size_t j = 0; j < kCount; ++j) {
      double both = 0;
      for (std::size_t k = 0; k < x.size(); ++k) both += function(i, k) * function(j, k);
      matrix[i * kCount + j] = both / (size[i] * size[j]) + (i == j ? kApart : 0);
    }
  }
  if (!solve_positive_definite(matrix, right, share)) return;
  for (std::size_t k = 0; k < x.size(); ++k)
    for (std::size_t i = 0; i < kCount; ++i) difference[k] -= share[i] * function(i, k) / size[i];
}

/// Power per line of the velocity's noise, with its standard deviation, and of the displacement's.
struct NoisePowers {
  double velocity = 0, displacement = 0, velocity_spread = 0;
};

/// The likeliest powers under which these lines are velocity + displacement * gains: Fisher's
/// scoring. Neither is negative; where the velocity has none, nothing else is told.
NoisePowers noise_powers(std::span<const double> lines, std::span<const double> gains) {
  constexpr int kIterations = 50;
  constexpr double kSettled = 1e-4;
  NoisePowers found;
  for (const double line : lines) found.velocity += line / static_cast<double>(lines.size());
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    // Each line counts by how far it scatters under the powers so far.
    const NoisePowers before = found;
    double one = 0, with = 0, gained = 0, right = 0, right_gained = 0;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const double expected = before.velocity + before.displacement * gains[k];
      const double weight = 1 / (expected * expected);
      one += weight;
      with += weight * gains[k];
      gained += weight * gains[k] * gains[k];
      right += weight * lines[k];
      right_gained += weight * gains[k] * lines[k];
    }

    // The powers that come nearest to the lines then, which end where they have settled.
    const double determinant = one * gained - with * with;
    found = {(right * gained - right_gained * with) / determinant,
             (right_gained * one - right * with) / determinant,
             std::sqrt(kOfWindow * gained / determinant)};
    if (!(found.velocity > 0)) return {};
    if (found.displacement <= 0) found.velocity = right / one, found.displacement = 0;
    if (std::abs(found.velocity - before.velocity) <= kSettled * found.velocity &&
        std::abs(found.displacement - before.displacement) <= kSettled * found.displacement)
      break;
  }
  return found;
}

/// Whether every octave of the spectrum, from the highest down, is as large as the noise that was
/// found.
bool is_noise(std::span<const double> lines, std::span<const double> gains,
              const NoisePowers& noise) {
  constexpr std::size_t kFewestLines = 16;
  constexpr double kFactor = 2, kDeviations = 2;  // that it may be off, and beyond that by chance
  for (std::size_t end = lines.size(); end > kFewestLines;) {
    const std::size_t first = end >= 2 * kFewestLines ? end / 2 : 0;
    double share = 0;
    for (std::size_t k = first; k < end; ++k)
      share += lines[k] / (noise.velocity + noise.displacement * gains[k]) /
               static_cast<double>(end - first);
    const double chance = std::sqrt(kOfWindow / static_cast<double>(end - first));
    if (!(std::abs(std::log(share)) < std::log(kFactor) + kDeviations * chance)) return false;
    end = first;
  }
  return true;
}

/// Whether single samples stand out, as where a triangle turns: their spectrum is white as well. By
/// the fourth moment, which is 3 squares of the second of normal noise, within sqrt(24 / n).
bool has_leaps(std::span<const double> difference) {
  constexpr double kDeviations = 4;
  double second = 0, fourth = 0;
  for (const double value : difference) {
    second += value * value;
    fourth += value * value * value * value;
  }
  const auto n = static_cast<double>(difference.size());
  return fourth * n > (3 + kDeviations * std::sqrt(24 / n)) * second * second;
}

/// A first-order low-pass forward and backward: its gain is 1 / (1 + (f / cutoff)^2).
std::vector<double> slow_part(std::span<const double> values, double cutoff_hz, double dt) {
  constexpr double kHighest = 0.45;  // of the sample rate, above which all is slow
  if (!(cutoff_hz * dt < kHighest)) return {values.begin(), values.end()};
  const double pace = std::tan(std::numbers::pi * cutoff_hz * dt);
  const double through = pace / (1 + pace);
  const auto margin = static_cast<std::size_t>(std::ceil(2 / (cutoff_hz * dt)));
  return filter_zero_phase({{through, through, 0, (pace - 1) / (1 + pace), 0}}, values, margin);
}

}  // namespace

std::optional<JointVelocity> joint_velocity(std::span<const double> x, std::span<const double> v,
                                            double dt) {
  constexpr std::size_t kFewest = 32;
  constexpr double kLeastNoise = 0.005, kMostOfMotion = 0.1, kMostLeft = 0.9;
  if (x.size() < kFewest) return {};

  // What the two sensors do not agree on.
  std::vector<double> difference = slope_of(x, dt);
  for (std::size_t k = 0; k < v.size(); ++k) difference[k] -= v[k];
  const double differs = root_mean_square(difference);
  take_off_motion(x, dt, difference);
  const double noisy = root_mean_square(difference);
  if (!(noisy > kLeastNoise * root_mean_square(v)) ||
      differs * differs - noisy * noisy > std::pow(kMostOfMotion * root_mean_square(v), 2))
    return {};

  // How much of it is of either sensor.
  const std::vector<double> lines = mean_power_spectrum(difference, dt).power;
  std::vector<double> gains(lines.size());
  for (std::size_t k = 0; k < gains.size(); ++k)
    gains[k] = slope_gain(
        std::numbers::pi * static_cast<double>(k) / static_cast<double>(lines.size() - 1), dt);
  NoisePowers noise = noise_powers(lines, gains);
  if (!(noise.velocity > 0) || !is_noise(lines, gains, noise) || has_leaps(difference)) return {};

  // Whether that pays, with the least noise of the velocity that is likely: where it is small
  // beside that of the slope, it is hardly known.
  constexpr double kLikely = 2;
  noise.velocity -= kLikely * noise.velocity_spread;
  if (noise.velocity <= 0) return {};
  double left = 0;
  for (const double gain : gains)
    left +=
        noise.velocity * noise.displacement * gain / (noise.velocity + noise.displacement * gain);
  JointVelocity joint{
      {}, std::sqrt(noise.velocity * static_cast<double>(lines.size())), std::sqrt(left)};
  if (!(joint.own_noise > kLeastNoise * root_mean_square(v) &&
        joint.noise < kMostLeft * joint.own_noise))
    return {};

  // What is slow of it is the velocity sensor's noise.
  joint.velocity = slow_part(
      difference, std::sqrt(noise.velocity / noise.displacement) / (2 * std::numbers::pi), dt);
  for (std::size_t k = 0; k < v.size(); ++k) joint.velocity[k] += v[k];
  return joint;
}

}  // namespace dashpot
