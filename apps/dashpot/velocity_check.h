#pragma once
#include <string>
#include <vector>

#include "dashpot/dataset.h"

namespace dashpot::cli {

/// How well velocity derived from displacement agrees with the measured one.
struct VelocityCheck {
  std::string record;
  double cutoff_hz = 0;
  double rms_percent = 0;  ///< rms of the difference over rms of the measured velocity
};

/// One per uniformly sampled record that has both. cutoff_hz 0: chosen per record, as on loading.
std::vector<VelocityCheck> check_velocities(const Dataset& dataset, double cutoff_hz);

}  // namespace dashpot::cli
