#include "dashpot/report/velocity_check.h"

#include <cmath>

#include "dashpot/record/differentiate.h"

namespace dashpot {
namespace {

bool is_measured(const Channel& motion) {
  return !motion.origin.starts_with("derived") && !motion.origin.starts_with("integrated");
}

double rms_difference_percent(const std::vector<double>& derived,
                              const std::vector<double>& measured) {
  double difference = 0, power = 0;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    difference += (derived[k] - measured[k]) * (derived[k] - measured[k]);
    power += measured[k] * measured[k];
  }
  return 100 * std::sqrt(difference / power);
}

}  // namespace

std::vector<VelocityCheck> check_velocities(const Dataset& dataset, double cutoff_hz) {
  constexpr std::size_t kFewestSamples = 4;  // to differentiate
  std::vector<VelocityCheck> checks;
  for (const Record& record : dataset.records) {
    const Channel* displacement = record.find("displacement");
    const Channel* velocity = record.find("velocity");
    if (!displacement || !velocity || !is_measured(*velocity) || !is_measured(*displacement) ||
        record.sample_time <= 0 || record.size() < kFewestSamples)
      continue;

    // Derive it as on loading, and compare over the whole record.
    const Derivative derived =
        smooth_derivative(displacement->samples, record.sample_time, cutoff_hz);
    const double percent = rms_difference_percent(derived.slope, velocity->samples);
    if (std::isfinite(percent))
      checks.push_back({record.name, derived.cutoff_hz, percent});  // not without motion
  }
  return checks;
}

}  // namespace dashpot
