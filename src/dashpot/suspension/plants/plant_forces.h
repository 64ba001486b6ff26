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

/// How many coordinates, struts and tyres a plant has.
struct PlantSizes {
  std::size_t coordinates, struts, tyres;
};
/// Those of a quarter car, which the compiler knows: its few sums are straight code, not loops.
struct QuarterCarSizes {
  static constexpr std::size_t coordinates = 2, struts = 1, tyres = 1;
};

/// along(row, q) of a plant with these sizes.
template <class Sizes>
double along(Sizes sizes, const std::vector<double>& row, const double* q) noexcept {
  const double* const factors = row.data();
  double sum = 0;
  for (std::size_t k = 0; k < sizes.coordinates; ++k) sum += factors[k] * q[k];
  return sum;
}

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
  /// The same at several instants at once.
  void feet(std::size_t tyre, std::span<const double> t, std::span<FootMotion> out) const noexcept;
  /// N, of the tyre on the road; 0 where contact is lost and tyres may lift.
  template <class Sizes>
  double tyre_load(Sizes sizes, std::size_t tyre, const FootMotion& ground,
                   const double* x) const noexcept;

  /// g of M q'' + C q' + K q = g, N: all forces that are not linear in x, with these of the struts.
  void add_up(double t, std::span<const double> x, std::span<const double> strut_forces,
              std::span<double> g) const noexcept;
  /// q'' with these forces of struts.
  void accelerate(double t, std::span<const double> x, std::span<const double> strut_forces,
                  std::span<double> out) const noexcept;
  /// run(sizes) with the sizes of this plant.
  template <class Run>
  void with_sizes(Run run) const {
    if (is_quarter_car_)
      run(QuarterCarSizes{});
    else
      run(sizes_);
  }
  /// The same as above for a caller that knows the sizes, and has the road under the tyres at t:
  /// foot_of(tyre).
  template <class Sizes>
  DamperInput strut_motion(Sizes sizes, std::size_t strut, double t, const double* x,
                           double current) const noexcept;
  template <class Sizes, class FootOf>
  void accelerate(Sizes sizes, double t, const double* x, const double* strut_forces,
                  FootOf foot_of, double* out) const noexcept;
  /// Where the plant would rest on the ground as it is under its tyres, q; or with the ground at
  /// these heights, m.
  void resting_place(std::span<const FootMotion> feet, std::span<double> q) const noexcept;
  void resting_place(std::span<const double> heights, std::span<double> q) const noexcept;

  const PlantSizes& sizes() const { return sizes_; }
  /// Whether it is a quarter car on a road, without friction, whose tyre never lifts.
  bool is_plain_quarter_car() const {
    return is_quarter_car_ && shaken_.empty() && !plant_.tyres_may_lift &&
           !plant_.struts[0].track && !(plant_.struts[0].friction > 0);
  }
  const Plant& plant() const { return plant_; }
  const StrutResistance<double>& resistance(std::size_t strut) const { return resistances_[strut]; }
  const TyreContact<double>& contact(std::size_t tyre) const { return contacts_[tyre]; }
  const LinearPlant& linear() const { return linear_; }
  /// q'' row by row: by x, by strut forces, by the road's pushes on the tyres.
  const std::vector<double>& by_state() const { return by_state_; }
  const std::vector<double>& by_strut() const { return by_strut_; }
  const std::vector<double>& by_tyre() const { return by_tyre_; }

 private:
  const Plant& plant_;
  const GroundMotion& ground_;
  LinearPlant linear_;
  PlantSizes sizes_;
  bool is_quarter_car_;                               ///< has QuarterCarSizes
  std::vector<StrutResistance<double>> resistances_;  ///< one per strut
  std::vector<TyreContact<double>> contacts_;         ///< one per tyre
  /// The push of the road on a wheel, N, without the pull of a tyre that has lifted.
  double push(std::size_t tyre, const FootMotion& ground, const double* x) const noexcept;
  /// Adds where the plant would rest with this tyre alone on this height, m.
  void add_resting(std::size_t tyre, double height, std::span<double> q) const noexcept;

  std::vector<double> by_state_, by_strut_, by_tyre_;
  std::vector<double> shaken_;   ///< M e; empty where the ground does not shake
  std::vector<double> resting_;  ///< size x tyres: K^-1 row k
};

inline DamperInput PlantForces::strut_motion(std::size_t strut, double t, std::span<const double> x,
                                             double current) const noexcept {
  return strut_motion(sizes_, strut, t, x.data(), current);
}

template <class Sizes>
DamperInput PlantForces::strut_motion(Sizes sizes, std::size_t strut, double t, const double* x,
                                      double current) const noexcept {
  const Strut& s = plant_.struts[strut];
  const double* const row = s.row.data();
  DamperInput motion{0, 0, current};
  for (std::size_t k = 0; k < sizes.coordinates; ++k) motion.displacement += row[k] * x[k];
  for (std::size_t k = 0; k < sizes.coordinates; ++k)
    motion.velocity += row[k] * x[sizes.coordinates + k];
  if (s.track) {
    const FootMotion ground = ground_.foot(t, *s.track, 0);
    motion.displacement -= ground.height;
    motion.velocity -= ground.velocity;
  }
  return motion;
}

template <class Sizes, class FootOf>
void PlantForces::accelerate(Sizes sizes, double t, const double* x, const double* strut_forces,
                             FootOf foot_of, double* out) const noexcept {
  const double shake = shaken_.empty() ? 0 : ground_.acceleration(t);

  // Row by row: shaking, state, strut forces.
  const double* a = by_state_.data();
  const double* b = by_strut_.data();
  for (std::size_t i = 0; i < sizes.coordinates; ++i) {
    double sum = shaken_.empty() ? 0 : -plant_.ground[i] * shake;
    for (std::size_t k = 0; k < 2 * sizes.coordinates; ++k) sum += *a++ * x[k];
    for (std::size_t s = 0; s < sizes.struts; ++s) sum += *b++ * strut_forces[s];
    out[i] = sum;
  }

  // The tyres, whose push depends on the road and on the motion.
  for (std::size_t w = 0; w < sizes.tyres; ++w) {
    const double pushed = push(w, foot_of(w), x);
    for (std::size_t i = 0; i < sizes.coordinates; ++i)
      out[i] += by_tyre_[i * sizes.tyres + w] * pushed;
  }
}

template <class Sizes>
double PlantForces::tyre_load(Sizes sizes, std::size_t tyre, const FootMotion& ground,
                              const double* x) const noexcept {
  // By the tyre's deflection, as it is recorded. dashpot::tyre_load() groups the same sum by the
  // road's push, which rounds differently.
  const Tyre& w = plant_.tyres[tyre];
  const double height = along(sizes, w.row, x), rate = along(sizes, w.row, x + sizes.coordinates);
  const double load =
      w.static_load + w.stiffness * (ground.height - height) + w.damping * (ground.velocity - rate);
  return plant_.tyres_may_lift ? std::fmax(load, 0) : load;
}

inline double PlantForces::push(std::size_t which, const FootMotion& ground,
                                const double* x) const noexcept {
  const TyreContact<double>& tyre = contacts_[which];
  const double push = road_push(tyre, ground.height, ground.velocity);
  if (!plant_.tyres_may_lift) return push;

  const std::vector<double>& row = plant_.tyres[which].row;
  const double height = along(row, x), rate = along(row, x + plant_.size());
  return push_on_wheel(tyre, push, dashpot::tyre_load(tyre, push, height, rate));
}

inline FootMotion PlantForces::foot(std::size_t tyre, double t) const noexcept {
  return ground_.foot(t, plant_.tyres[tyre].track, plant_.tyres[tyre].behind);
}

inline void PlantForces::feet(std::size_t tyre, std::span<const double> t,
                              std::span<FootMotion> out) const noexcept {
  ground_.feet_at(t, plant_.tyres[tyre].track, plant_.tyres[tyre].behind, out);
}

inline double PlantForces::strut_extra(std::size_t strut,
                                       const DamperInput& motion) const noexcept {
  const Strut& s = plant_.struts[strut];
  const double sliding = s.friction > 0 ? std::tanh(motion.velocity / s.friction_speed) : 0;
  return strut_resistance(resistances_[strut], motion.displacement, sliding);
}

}  // namespace dashpot
