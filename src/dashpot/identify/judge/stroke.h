#pragma once
#include <cstddef>
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

/// Between two turns of a motion, on the mean. A turn is a change of direction at a tenth of the
/// top speed at least, so that noise at rest is none.
struct Stroke {
  double way = 0;       ///< m
  double duration = 0;  ///< s
};
Stroke mean_stroke(const std::vector<DamperInput>& inputs, const std::vector<double>& time);

}  // namespace dashpot
