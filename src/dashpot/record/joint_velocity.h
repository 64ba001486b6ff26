#pragma once
#include <optional>
#include <span>
#include <vector>

namespace dashpot {

/// The velocity that a sensor of its own and one of the displacement show together.
struct JointVelocity {
  std::vector<double> velocity;  ///< m/s
  /// m/s rms, by which the sensor's own velocity and this one are uncertain.
  double own_noise = 0, noise = 0;
};

/// Where both sensors see one motion, each with white noise of its own, the slope of the
/// displacement minus the velocity is noise alone, whose spectrum a + b w^2 tells how much there is
/// of either. Its slow part is then the velocity's, its quick part the displacement's: a low-pass
/// of the first order run forward and backward, cut off at sqrt(a / b), takes the best share of it
/// (the complementary filter of Higgins 1975, without phase). What goes with the motion in that
/// difference, a gain or a delay, stays with the velocity.
/// x m, v m/s, dt s, uniform. None where the noise of v is less than 0.5 % of it or hardly becomes
/// less, and where the two differ by something else than normal noise, or by more than a tenth
/// of the motion.
std::optional<JointVelocity> joint_velocity(std::span<const double> x, std::span<const double> v,
                                            double dt);

}  // namespace dashpot
