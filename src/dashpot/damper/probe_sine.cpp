#include "dashpot/damper/probe_sine.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "dashpot/base/parallel.h"

namespace dashpot {
namespace {

constexpr std::array kFrequencies{1.0,  3.0,  8.0,  14.0,  20.0,  28.0,
                                  40.0, 55.0, 75.0, 100.0, 140.0, 200.0};  // Hz
constexpr std::array kSmallAmplitudes{1e-7, 2e-6};  // m; a car may swing on with a few um
constexpr double kLeastAmplitude = 1e-5;            // m, of those up to the data's
constexpr std::size_t kAmplitudes = 4, kDrives = 5;

// For what is unproven, as well: where bodies of cars move, and beyond the data.
constexpr std::array kMoreFrequencies{1.7, 5.0};  // Hz
constexpr std::size_t kCloseAmplitudes = 12;
constexpr std::array kBeyond{3.0, 20.0};  // times the data's

constexpr int kMostCycles = 12;  // until two are alike

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

double mean_of_cycle(std::span<const double> force) {
  double mean = 0;
  for (std::size_t k = 0; k < kProbeSamples; ++k) mean += force[k] / kProbeSamples;
  return mean;
}

}  // namespace

std::vector<ProbeSine> probe_sines(Domain domain, bool about_positions, bool unproven) {
  if (!(domain.velocity_max > domain.velocity_min))
    domain = usual_domain(domain.current_min, domain.current_max);
  const double middle = (domain.displacement_max + domain.displacement_min) / 2;
  const double speed = std::max(domain.velocity_max, -domain.velocity_min);
  double stroke = (domain.displacement_max - domain.displacement_min) / 2;
  if (!(stroke > 0)) stroke = usual_domain(0, 0).displacement_max;

  std::vector<double> frequencies(kFrequencies.begin(), kFrequencies.end());
  if (unproven)
    frequencies.insert(frequencies.end(), kMoreFrequencies.begin(), kMoreFrequencies.end());

  std::vector<ProbeSine> sines;
  for (const double drive : spaced(domain.current_min, domain.current_max, kDrives, false))
    for (const double frequency : frequencies) {
      const double most = std::min(stroke, speed / (2 * std::numbers::pi * frequency));
      std::vector<double> amplitudes =
          spaced(kLeastAmplitude, most, unproven ? kCloseAmplitudes : kAmplitudes, true);
      amplitudes.insert(amplitudes.begin(), kSmallAmplitudes.begin(), kSmallAmplitudes.end());
      for (const double amplitude : amplitudes) {
        sines.push_back({frequency, amplitude, middle, drive});
        if (!about_positions || amplitude < kLeastAmplitude || amplitude > stroke / 10) continue;
        for (const double side : {-0.7, 0.7})
          sines.push_back({frequency, amplitude, middle + side * stroke, drive});
      }
      if (!unproven) continue;
      for (const double times : kBeyond) sines.push_back({frequency, times * most, middle, drive});
    }
  return sines;
}

std::vector<DamperInput> cycle_of(const ProbeSine& sine) {
  std::vector<DamperInput> inputs;
  const double w = 2 * std::numbers::pi * sine.frequency;
  for (std::size_t k = 0; k <= kProbeSamples; ++k) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.5) / kProbeSamples;
    inputs.push_back({sine.position + sine.amplitude * std::sin(angle),
                      sine.amplitude * w * std::cos(angle), sine.drive});
  }
  return inputs;
}

ProbedCycle measured(std::span<const DamperInput> inputs, std::span<const double> force,
                     double step) {
  const double mean = mean_of_cycle(force);
  ProbedCycle cycle;
  for (std::size_t k = 0; k < kProbeSamples; ++k) {
    const double way = inputs[k + 1].displacement - inputs[k].displacement;
    const double work = ((force[k] + force[k + 1]) / 2 - mean) * way;
    cycle.work += work;
    cycle.passed += std::abs(work);
    cycle.squares += inputs[k].velocity * inputs[k].velocity * step;
  }
  return cycle;
}

std::vector<ProbedCycle> settled_cycles(const DamperModel& model, std::span<const ProbeSine> sines,
                                        int threads) {
  std::vector<ProbedCycle> cycles(sines.size());
  parallel_for(sines.size(), threads, [&](std::size_t k) { cycles[k] = settled(model, sines[k]); });
  return cycles;
}

std::vector<double> share_slopes(std::span<const DamperInput> inputs, std::span<const double> force,
                                 const ProbedCycle& cycle) {
  const double mean = mean_of_cycle(force), share = cycle.share();
  std::vector<double> slopes(inputs.size());

  // share = work / passed; each step's work counts in both, in the latter by its size.
  double by_mean = 0;
  for (std::size_t k = 0; k < kProbeSamples; ++k) {
    const double way = inputs[k + 1].displacement - inputs[k].displacement;
    const double work = ((force[k] + force[k + 1]) / 2 - mean) * way;
    const double slope = (work < 0 ? 1 + share : 1 - share) * way / cycle.passed;
    slopes[k] += slope / 2;
    slopes[k + 1] += slope / 2;
    by_mean -= slope;
  }
  for (std::size_t k = 0; k < kProbeSamples; ++k) slopes[k] += by_mean / kProbeSamples;
  return slopes;
}

}  // namespace dashpot
