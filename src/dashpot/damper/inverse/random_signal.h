#pragma once
#include <vector>

#include "dashpot/base/random.h"

namespace dashpot {

/// Band-limited noise as a sum of 16 sines of equal amplitude, one from each of equal bands: mean
/// 0, variance 1, with its exact derivative. The same random numbers give the same signal.
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
