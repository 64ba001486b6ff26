#pragma once
#include <cstring>

#include "dashpot/suspension/dampers/law_loop.h"
#include "dashpot/suspension/dampers/soft_friction.h"
#include "dashpot/suspension/plants/plant_forces.h"

namespace dashpot {

/// A hysteresis loop among the dampers' states.
struct FollowedLoop {
  LoopPath<LawLoopKind> path;
  std::size_t damper, place;           ///< the number of the damper, and the place of z in y
  std::optional<std::size_t> series;   ///< the place in y whose rate the loop's speed is less by
  double r = 0, z = NAN;               ///< as last written into a state
  double m = 0, steep = 1, along = 0;  ///< at the last call of rates(): LoopPath's
};

/// Numbers of the body and of the wheel, which one instruction adds or multiplies.
typedef double BodyAndWheel __attribute__((vector_size(2 * sizeof(double))));

/// The equations of a quarter car on a road, without friction, with a damper that is a law without
/// a lag of its own: what PlantEquations has for any plant, in the same order of sums and so the
/// same to the bit, but with its numbers in one place, so that a step's stages are straight code.
struct RoadCar {
  /// y, or its rates. kStates: of the law; a loop that is followed stands there by its r.
  template <std::size_t kStates>
  struct State {
    BodyAndWheel heights, speeds;
    double law[kStates + 1];

    /// From and to [body, wheel, their speeds, states of the law].
    [[gnu::always_inline]] inline void get(const double* y) {
      std::memcpy(&heights, y, sizeof heights);
      std::memcpy(&speeds, y + 2, sizeof speeds);
      for (std::size_t k = 0; k < kStates; ++k) law[k] = y[4 + k];
    }
    [[gnu::always_inline]] inline void put(double* y) const {
      std::memcpy(y, &heights, sizeof heights);
      std::memcpy(y + 2, &speeds, sizeof speeds);
      for (std::size_t k = 0; k < kStates; ++k) y[4 + k] = law[k];
    }
  };

  BodyAndWheel row;                ///< of the strut
  BodyAndWheel by_state[4];        ///< q'' by each of heights and speeds
  BodyAndWheel by_strut, by_tyre;  ///< q'' by the strut's force and by the road's push on the wheel
  StrutResistance<double> stops;
  TyreContact<double> tyre;
  double ratio, factor;  ///< MountedDamper's
  SoftLaw law;
  FollowedLoop* loop;  ///< among its states; null: none is followed
  double* states;      ///< those at the last call of rates() where a loop is, by its z

  /// Forces at the last call of rates(), N.
  struct Forces {
    double damper, strut;
  };
  /// dy/dt with these parameters of the law, on the road as it is there. kFollows: there is a loop.
  template <bool kFollows, std::size_t kStates>
  [[gnu::always_inline]] inline Forces rates(const double* parameters, const FootMotion& foot,
                                             const State<kStates>& y, State<kStates>& dy) const {
    double z[kStates + 1]{};
    for (std::size_t k = 0; k < kStates; ++k) z[k] = y.law[k];
    if constexpr (kFollows) unfold<kStates>(z);

    // The damper's force, and the rates of its states.
    const BodyAndWheel ways = row * y.heights, speeds = row * y.speeds;
    const double x = ways[0] + ways[1], v = speeds[0] + speeds[1];
    DamperInput motion{x, v, 0};
    if (ratio != 1) motion = {ratio * x, ratio * v, 0};
    double damper = factor * law.flow(parameters, motion, z, dy.law);
    if (ratio != 1) damper *= ratio;
    const double strut = damper + strut_resistance(stops, x, 0.0);
    if constexpr (kFollows) fold<kStates>(motion.velocity, dy.law);

    // The motion under it and on this road.
    const double pushed = road_push(tyre, foot.height, foot.velocity);
    BodyAndWheel sum{};
    for (std::size_t k = 0; k < 2; ++k) sum += by_state[k] * y.heights[k];
    for (std::size_t k = 0; k < 2; ++k) sum += by_state[2 + k] * y.speeds[k];
    sum += by_strut * strut;
    dy.heights = y.speeds;
    dy.speeds = sum + by_tyre * pushed;
    return {damper, strut};
  }

 private:
  /// The loop's z in the place of its r.
  template <std::size_t kStates>
  [[gnu::always_inline]] inline void unfold(double* z) const {
    for (std::size_t k = 0; k < kStates; ++k) {
      if (k == loop->place - 4) {
        const auto place = loop->path.place(z[k]);
        loop->m = place.m;
        loop->steep = place.steep;
        z[k] = loop->path.unfolded(place);
      }
      states[k] = z[k];
    }
  }
  /// The rate of its r in the place of that of its z, at this speed of the damper, m/s.
  template <std::size_t kStates>
  [[gnu::always_inline]] inline void fold(double speed, double* dz) const {
    loop->along = loop->path.along(speed - (loop->series ? dz[*loop->series - 4] : 0));
    for (std::size_t k = 0; k < kStates; ++k)
      if (k == loop->place - 4)
        dz[k] = loop->path.folded_rate(dz[k], loop->along, {loop->m, loop->steep});
  }
};

}  // namespace dashpot
