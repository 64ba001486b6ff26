#pragma once
#include "dashpot/ground_motion.h"

namespace dashpot {

/// A chirp from f0 to f1 Hz within `duration` s, at t s.
struct ChirpPoint {
  double phase, frequency;  ///< rad, Hz
};
ChirpPoint linear_chirp(double f0, double f1, double duration, double t) noexcept;
ChirpPoint exponential_chirp(double f0, double f1, double duration, double t) noexcept;

/// Heights and amplitudes in m, frequencies in Hz, speeds in m/s; the step at the instant `at`, s.
GroundPointer step_ground(double height, double at);
GroundPointer sine_ground(double amplitude, double frequency);
/// Ends at rest height after `duration`; `exponential` rises by equal ratios in equal times.
GroundPointer chirp_ground(double amplitude, double f0, double f1, double duration,
                           bool exponential);
/// (h / 2) (1 - cos(2 pi s / L)) along the way, met `at` metres from the start.
GroundPointer bump_ground(double height, double length, double speed, double at);

/// A ground acceleration over time, m/s^2, straight between its samples; 0 after them.
GroundPointer shaking_ground(std::string description, double sample_time,
                             std::vector<double> acceleration);

}  // namespace dashpot
