#pragma once
#include "dashpot/evaluate.h"

namespace dashpot {

/// What of a model's error follows the acceleration, as the inertia of parts between load cell and
/// damper does.
struct LeftInertia {
  double mass = 0;   ///< kg, by least squares over all records, their means apart
  double share = 0;  ///< of the error's sum of squares that goes with it
};

/// Of the records with curves; nothing where there is no acceleration or no error.
LeftInertia left_inertia(const Evaluation& evaluation);

}  // namespace dashpot
