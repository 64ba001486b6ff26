#include "dashpot/damper/inverse/random_signal.h"

#include <cmath>
#include <numbers>

namespace dashpot {
namespace {

constexpr int kSines = 16;
const double kAmplitude = std::sqrt(2.0 / kSines);

}  // namespace

RandomSignal::RandomSignal(Random& random, double low, double high) {
  for (int k = 0; k < kSines; ++k) {  // one sine from each of equal bands
    rate_.push_back(2 * std::numbers::pi * (low + (high - low) * (k + random.uniform()) / kSines));
    phase_.push_back(random.uniform(0, 2 * std::numbers::pi));
  }
}

double RandomSignal::at(double t) const {
  double sum = 0;
  for (std::size_t k = 0; k < rate_.size(); ++k) sum += std::sin(rate_[k] * t + phase_[k]);
  return kAmplitude * sum;
}

double RandomSignal::derivative(double t) const {
  double sum = 0;
  for (std::size_t k = 0; k < rate_.size(); ++k)
    sum += rate_[k] * std::cos(rate_[k] * t + phase_[k]);
  return kAmplitude * sum;
}

}  // namespace dashpot
