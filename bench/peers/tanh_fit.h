#pragma once
#include "peer.h"

// The least squares problem of fitting kTanh, as one writes it for a solver: residuals and their derivatives.
namespace peer {

inline void residuals(const double* w, const dashpot::TrainingSamples& samples, double* r, double* jacobian,
                      std::size_t sample_step, std::size_t parameter_step) {
  for (std::size_t s = 0; s < samples.targets.size(); ++s) {
    const double* x = &samples.inputs[2 * s];
    double y = w[40], a[10];
    for (int n = 0; n < 10; ++n) {
      a[n] = std::tanh(w[2 * n] * x[0] + w[2 * n + 1] * x[1] + w[20 + n]);
      y += w[30 + n] * a[n];
    }
    r[s] = y - samples.targets[s];
    if (!jacobian) continue;
    double* j = jacobian + s * sample_step;
    for (int n = 0; n < 10; ++n) {
      const double d = w[30 + n] * (1 - a[n] * a[n]);
      j[(2 * n) * parameter_step] = d * x[0];
      j[(2 * n + 1) * parameter_step] = d * x[1];
      j[(20 + n) * parameter_step] = d;
      j[(30 + n) * parameter_step] = a[n];
    }
    j[40 * parameter_step] = 1;
  }
}

inline bool good_enough(double sum_of_squares, std::size_t samples) {
  return sum_of_squares <= kGoodEnough * kGoodEnough * static_cast<double>(samples);
}

}  // namespace peer
