#pragma once
#include <cmath>
#include <span>
#include <vector>

#include "dashpot/ground_motion.h"
#include "dashpot/mounted_damper.h"
#include "dashpot/plant.h"
#include "dashpot/suspension/plants/linear.h"
#include "dashpot/suspension/plants/nonlinear_forces.h"

namespace dashpot {

/// Forces of a plant on its ground at an instant t, s, in SI. x = [q, q']. Plant and ground must
/// outlive it. Evaluations allocate nothing.
class PlantForces {
 public:
  PlantForces(const Plant& plant, const GroundMotion& ground);

  /// Deflection and velocity of a strut, extension positive, with this current.
  DamperInput strut_motion(std::size_t strut, double t, std::span<const double> x,
                           double current) const noexcept;
  /// Stops and friction of a strut, N.
  double strut_extra(std::size_t strut, const DamperInput& motion) const noexcept;
  FootMotion foot(std::size_t tyre, double t) const noexcept;
  /// N, of the tyre on the road; 0 where contact is lost and tyres may lift.
  double tyre_load(std::size_t tyre, double t, std::span<const double> x) const noexcept;

  /// g of M q'' + C q' + K q = g, N: all forces that are not linear in x, with these of the struts.
  void add_up(double t, std::span<const double> x, std::span<const double> strut_forces,
              std::span<double> g) const noexcept;
  /// q'' with these forces of struts.
  void accelerate(double t, std::span<const double> x, std::span<const double> strut_forces,
                  std::span<double> out) const noexcept;
  /// Where the plant would rest on the ground as it is, q; or with the ground at these heights, m,
  /// under its tyres.
  void resting_place(double t, std::span<double> q) const noexcept;
  void resting_place(std::span<const double> heights, std::span<double> q) const noexcept;

  const LinearPlant& linear() const { return linear_; }
  /// q'' row by row: by x, by strut forces, by the road's pushes on the tyres.
  const std::vector<double>& by_state() const { return by_state_; }
  const std::vector<double>& by_strut() const { return by_strut_; }
  const std::vector<double>& by_tyre() const { return by_tyre_; }

 private:
  const Plant& plant_;
  const GroundMotion& ground_;
  LinearPlant linear_;
  std::vector<StrutResistance<double>> resistances_;  ///< one per strut
  std::vector<TyreContact<double>> contacts_;         ///< one per tyre
  /// The push of the road on a wheel, N, without the pull of a tyre that has lifted.
  double push(std::size_t tyre, double t, std::span<const double> x) const noexcept;
  /// Adds where the plant would rest with this tyre alone on this height, m.
  void add_resting(std::size_t tyre, double height, std::span<double> q) const noexcept;

  std::vector<double> by_state_, by_strut_, by_tyre_;
  std::vector<double> shaken_;   ///< M e; empty where the ground does not shake
  std::vector<double> resting_;  ///< size x tyres: K^-1 row k
};

inline DamperInput PlantForces::strut_motion(std::size_t strut, double t, std::span<const double> x,
                                             double current) const noexcept {
  const Strut& s = plant_.struts[strut];
  DamperInput motion{along(s.row, x.data()), along(s.row, x.data() + plant_.size()), current};
  if (s.track) {
    const FootMotion ground = ground_.foot(t, *s.track, 0);
    motion.displacement -= ground.height;
    motion.velocity -= ground.velocity;
  }
  return motion;
}

inline double PlantForces::strut_extra(std::size_t strut,
                                       const DamperInput& motion) const noexcept {
  const Strut& s = plant_.struts[strut];
  const double sliding = s.friction > 0 ? std::tanh(motion.velocity / s.friction_speed) : 0;
  return strut_resistance(resistances_[strut], motion.displacement, sliding);
}

}  // namespace dashpot
