#pragma once
#include <vector>

#include "dashpot/base/random.h"

namespace dashpot {

/// Band-limited noise as a sum of sines: mean 0, variance 1, with its exact derivative.
class RandomSignal {
 public:
  /// Frequencies between low and high, Hz.
  RandomSignal(Random& random, double low, double high);
  double at(double t) const;
  double derivative(double t) const;

 private:
  std::vector<double> rate_, phase_;  // rad/s, rad
};

}  // namespace dashpot
