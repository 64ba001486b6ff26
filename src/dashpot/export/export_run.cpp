#include "dashpot/export/export_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dashpot/base/random.h"

namespace dashpot {
namespace {

constexpr std::size_t kWaves = 5;

/// A sum of sines between -1 and 1 and its slope by time.
struct Waves {
  std::array<double, kWaves> rates, phases;  // rad/s, rad

  Waves(Random& random, double lowest, double highest) {
    for (std::size_t k = 0; k < kWaves; ++k) {
      rates[k] = 2 * std::numbers::pi * random.uniform(lowest, highest);
      phases[k] = random.uniform(0, 2 * std::numbers::pi);
    }
  }
  double at(double t) const {
    double sum = 0;
    for (std::size_t k = 0; k < kWaves; ++k) sum += std::sin(rates[k] * t + phases[k]);
    return sum / kWaves;
  }
  double slope(double t) const {
    double sum = 0;
    for (std::size_t k = 0; k < kWaves; ++k) sum += rates[k] * std::cos(rates[k] * t + phases[k]);
    return sum / kWaves;
  }
  double top_slope() const {
    double sum = 0;
    for (const double rate : rates) sum += rate;
    return sum / kWaves;
  }
};

double middle(double low, double high) { return 0.5 * (low + high); }

}  // namespace

std::vector<DamperInput> export_run(const Domain& domain, double sample_time, std::size_t count,
                                    const ExportRunOptions& options) {
  Random random(options.seed);
  const Waves motion(random, 0.5, options.fastest), command(random, 0.2, 0.5 * options.fastest);
  const double top_speed = std::min(-domain.velocity_min, domain.velocity_max);
  const double reach = std::min(0.5 * (domain.displacement_max - domain.displacement_min),
                                std::abs(top_speed) / motion.top_slope());

  // Motion and command about the middle of the domain, as far as its limits and speeds allow.
  const double centre = middle(domain.displacement_min, domain.displacement_max);
  const double current = middle(domain.current_min, domain.current_max);
  const double swing = 0.5 * (domain.current_max - domain.current_min);
  std::vector<DamperInput> run;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = sample_time * static_cast<double>(k);
    run.push_back(
        {centre + reach * motion.at(t), reach * motion.slope(t), current + swing * command.at(t)});
  }
  return run;
}

std::vector<double> force_along(const DamperModel& model, const std::vector<DamperInput>& inputs,
                                double sample_time) {
  std::vector<double> state(model.state_size()), force;
  model.rest(inputs.front(), state);
  force.push_back(model.force(inputs.front(), state));
  for (std::size_t k = 1; k < inputs.size(); ++k) {
    model.advance(inputs[k - 1], inputs[k], sample_time, state);
    force.push_back(model.force(inputs[k], state));
  }
  return force;
}

}  // namespace dashpot
