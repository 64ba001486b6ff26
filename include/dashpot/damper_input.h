// Layer: damper
#pragma once

// The input of every damper model, and the instants of a series of such inputs. SI, extension
// positive.

#include <cstddef>

namespace dashpot {

/// What a damper sees at one instant.
struct DamperInput {
  double displacement = 0;  ///< m, extension positive
  double velocity = 0;      ///< m/s, extension positive
  double current = 0;       ///< A commanded to the coil (V where the model is voltage-driven)
};

/// How far the samples of a series lie apart: as a column of times says, or all the same.
struct Steps {
  const double* time = nullptr;  ///< s, of every sample; null: all are `step` long
  double step = 0;               ///< s
  double to(std::size_t sample) const noexcept {
    return time ? time[sample] - time[sample - 1] : step;
  }
};

}  // namespace dashpot
