#pragma once
#include "dashpot/evaluate.h"

namespace dashpot {

/// What of a model's error follows the acceleration, as the inertia of parts between load cell and
/// damper does.
struct LeftInertia {
  double mass = 0;   ///< kg, by least squares over all records, their means apart
  double share = 0;  ///< of the error's sum of squares that goes with it
  /// What a hysteresis that a model lacks leaves has the other sign as a rule.
  bool is_told() const { return mass > 0 && share >= 0.1; }
};

/// Of the records with curves; nothing where there is no acceleration or no error.
LeftInertia left_inertia(const Evaluation& evaluation);

}  // namespace dashpot
