#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dashpot/damper/inverse/inverse.h"

namespace dashpot {

/// A motion on equal steps of time.
struct Motion {
  double sample_time = 1e-3;                   ///< s
  std::vector<double> displacement, velocity;  ///< m, m/s
  std::string description;                     ///< "10 mm at 1 Hz"
  std::size_t size() const { return displacement.size(); }
};

/// Size, duration and sampling of a motion.
struct MotionOptions {
  double amplitude = 0.02;    ///< m; of a random motion twice its standard deviation
  double frequency = 1;       ///< Hz; of a random motion the highest
  double duration = 10;       ///< s
  double sample_time = 1e-3;  ///< s
  std::uint64_t seed = 1;
};
/// A sine from the lowest displacement on, and band-limited noise from the seed. Both throw Error
/// on a size that makes no sense or on more than 1e7 samples.
Motion sine_motion(const MotionOptions& options);
Motion random_motion(const MotionOptions& options);

/// A force trace that the damper can give: a share, random and band-limited (Hz), of the way
/// between its forces at the least and at the greatest current, each held over the whole motion.
std::vector<double> admissible_force(const DamperModel& damper, const Motion& motion,
                                     const InverseLimits& limits, double band, std::uint64_t seed);

/// The force amplitude sin(2 pi frequency t), N, one per sample of the motion.
std::vector<double> sine_force(double amplitude, double frequency, const Motion& motion);

}  // namespace dashpot
