#include "dashpot/record/differentiate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "dashpot/base/parallel.h"
#include "dashpot/error.h"
#include "dashpot/numerics/filter.h"
#include "dashpot/numerics/spectrum.h"

namespace dashpot {
namespace {

constexpr std::size_t kFewestToDerive = 4;
constexpr std::size_t kThreadsPay = 100'000;  // samples from which threads pay

double rms_difference(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Whether the cut-off of `low` takes speed away from one of the fast stretches. `middle` and
/// `high` are the same velocity at twice and four times that cut-off. Of a motion that was cut the
/// second octave brings a sixteenth of what the first one brings; of noise it brings more, and of a
/// jump of the speed 0.7 times as much.
bool cuts_a_motion(std::span<const double> low, std::span<const double> middle,
                   std::span<const double> high, std::size_t stretch) {
  constexpr double kMostCut = 0.02, kMotionFalls = 4, kFast = 0.5;

  // How fast the stretches are; the first and the last one hold the ends of the filter.
  const std::size_t count = middle.size() / stretch;
  if (count < 3) return false;
  std::vector<double> speed(count, 0.0);
  const std::vector<double> rest(stretch, 0.0);
  for (std::size_t k = 1; k + 1 < count; ++k)
    speed[k] = rms_difference(middle.subspan(k * stretch, stretch), rest);
  const double fast = kFast * *std::max_element(speed.begin(), speed.end());

  for (std::size_t k = 1; k + 1 < count; ++k) {
    if (!(speed[k] > fast)) continue;
    const auto part = [&](std::span<const double> v) { return v.subspan(k * stretch, stretch); };
    const double first = rms_difference(part(low), part(middle));
    const double second = rms_difference(part(middle), part(high));
    if (first > kMostCut * speed[k] && kMotionFalls * second < first) return true;
  }
  return false;
}

/// What is slow for long and fast for a while, as the record of a shock dyno, has nearly all of its
/// power where it is slow. Doubles the cut-off for as long as a fast stretch loses speed by it. The
/// slope stays empty where there is no room for that.
Derivative raised_for_fast_stretches(std::span<const double> x, double dt, double cutoff_hz,
                                     double highest_hz) {
  constexpr double kPeriods = 5;  // of the cut-off in a stretch
  if (x.size() < kFewestToDerive || !(4 * cutoff_hz <= highest_hz)) return {cutoff_hz, {}};
  std::array<std::vector<double>, 3> slopes;  // at the cut-off, twice and four times that
  parallel_for(slopes.size(), x.size() < kThreadsPay ? 1 : 0, [&](std::size_t k) {
    slopes[k] = differentiate_zero_phase(x, dt, static_cast<double>(1 << k) * cutoff_hz);
  });
  auto& [low, middle, high] = slopes;
  for (;;) {
    const auto stretch = static_cast<std::size_t>(std::ceil(kPeriods / (cutoff_hz * dt)));
    if (!cuts_a_motion(low, middle, high, stretch)) break;
    cutoff_hz *= 2;
    low = std::move(middle);
    middle = std::move(high);
    if (!(4 * cutoff_hz <= highest_hz)) break;
    high = differentiate_zero_phase(x, dt, 4 * cutoff_hz);
  }
  return {cutoff_hz, std::move(low)};
}

/// The cut-off that the motion asks for, and the slope where that was taken on the way.
Derivative chosen_by_the_motion(std::span<const double> x, double dt) {
  constexpr double kPowerShare = 0.99, kMargin = 10, kLowest = 10, kHighestTimesDt = 0.4;
  const PowerSpectrum spectrum = mean_power_spectrum(x, dt);
  const double wanted =
      kPowerShare * std::accumulate(spectrum.power.begin(), spectrum.power.end(), 0.0);

  // The lowest frequency below which the wanted share of the power lies.
  double power = 0, motion_hz = 0;
  for (std::size_t k = 0; k < spectrum.power.size() && power < wanted; ++k) {
    power += spectrum.power[k];
    motion_hz = spectrum.spacing_hz * static_cast<double>(k);
  }
  const double highest = kHighestTimesDt / dt;
  const double chosen = std::min(std::max(kMargin * motion_hz, kLowest), highest);
  return raised_for_fast_stretches(x, dt, chosen, highest);
}

}  // namespace

std::vector<double> slope_of(std::span<const double> x, double dt) {
  const std::size_t last = x.size() - 1;
  std::vector<double> slope(x.size());
  slope[0] = (-3 * x[0] + 4 * x[1] - x[2]) / (2 * dt);
  slope[last] = (3 * x[last] - 4 * x[last - 1] + x[last - 2]) / (2 * dt);

  // Elimination from the left, where the ends are known. Its factors settle on 2 - sqrt(3) to the
  // last digit within so many samples.
  constexpr std::size_t kSettled = 16;
  std::array<double, kSettled> factors{};
  for (std::size_t k = 1; k < kSettled; ++k) factors[k] = 1 / (4 - factors[k - 1]);
  for (std::size_t k = 1; k < last; ++k)
    slope[k] = (3 / dt * (x[k + 1] - x[k - 1]) - slope[k - 1]) * factors[std::min(k, kSettled - 1)];
  for (std::size_t k = last - 1; k > 0; --k)
    slope[k] -= factors[std::min(k, kSettled - 1)] * slope[k + 1];
  return slope;
}

std::vector<double> differentiate_zero_phase(std::span<const double> x, double dt,
                                             double cutoff_hz) {
  if (x.size() < kFewestToDerive)
    throw Error("velocity from displacement", "only " + std::to_string(x.size()) + " samples",
                "at least " + std::to_string(kFewestToDerive) + " are needed");
  const std::vector<Biquad> lowpass = butterworth_lowpass(2, cutoff_hz, dt);
  // Within two periods of the cut-off the filter forgets its start to exp(-2 pi sqrt(2)) = 1e-4.
  const auto margin = static_cast<std::size_t>(std::ceil(2 / (cutoff_hz * dt)));
  return slope_of(filter_zero_phase(lowpass, x, margin), dt);
}

double choose_cutoff_hz(std::span<const double> x, double dt) {
  return chosen_by_the_motion(x, dt).cutoff_hz;
}

Derivative smooth_derivative(std::span<const double> x, double dt, double cutoff_hz) {
  Derivative derivative{cutoff_hz, {}};
  if (!(cutoff_hz > 0)) derivative = chosen_by_the_motion(x, dt);
  if (derivative.slope.empty())
    derivative.slope = differentiate_zero_phase(x, dt, derivative.cutoff_hz);
  return derivative;
}

}  // namespace dashpot
