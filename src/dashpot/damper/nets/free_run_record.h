#pragma once
#include <cstddef>
#include <vector>

#include "dashpot/damper_input.h"

namespace dashpot {

/// One record as models with states of their own are trained on it, in free run from rest.
struct FreeRunRecord {
  std::vector<DamperInput> inputs;
  std::vector<double> time, force;  ///< s, N: one per input
  std::size_t first = 0;            ///< scored from here on; what comes before is run through
};

struct FreeRunTrainReport {
  bool converged = false;
  int iterations = 0;
  double rmse = 0;  ///< N, offsets removed
};

/// Cost of a training at one set of its unknowns, and half its gradient by them.
struct FreeRunCost {
  double cost = 0;
  std::vector<double> gradient;
};

}  // namespace dashpot
