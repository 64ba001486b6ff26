#pragma once
#include <algorithm>

#include <boost/numeric/odeint.hpp>

#include "peer.h"

namespace peer {

/// CPU seconds of a ride by a controlled stepper of odeint. The stepper lives through all samples;
/// its last slope is the next one's first but where a command changes. At each sample on_sample(y,
/// slope) keeps what it likes and gives the command: whether it has changed.
template <class State, class Stepper, class System, class OnSample>
double ride_by(Stepper stepper, System system, State y, std::size_t samples, double sample,
               OnSample on_sample) {
  const double start = cpu_seconds();
  State slope{};
  double dt = sample;
  system(y, slope, 0);
  for (std::size_t k = 0;; ++k) {
    double t = static_cast<double>(k) * sample;
    const double end = static_cast<double>(k + 1) * sample;
    const bool changed = on_sample(y, slope);
    if (k == samples) break;
    if (changed) system(y, slope, t);
    while (t < end) {
      const bool last = t + dt >= end * (1 - 1e-14);
      double h = last ? end - t : dt;
      const bool taken =
          stepper.try_step(system, y, slope, t, h) == boost::numeric::odeint::success;
      if (!taken || !last) dt = h;
      if (taken && last) {
        t = end;
        dt = std::max(dt, h);
      }
    }
  }
  return cpu_seconds() - start;
}

}  // namespace peer
