#pragma once
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/suspension/dampers/law_loop.h"
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

/// The equations of a quarter car on a road, without friction, with a damper that is a law without
/// a lag of its own: what PlantEquations has for any plant, in the same order of sums and so the
/// same to the bit, but with its numbers in one place, so that a step's stages are straight code.
/// y = [body, wheel, their speeds, states of the law, a loop that is followed by its r].
struct RoadCar {
  double row[2];                   ///< of the strut
  double by_state[2][4];           ///< q'' by y
  double by_strut[2], by_tyre[2];  ///< q'' by the strut's force and by the road's push on the wheel
  StrutResistance<double> stops;
  TyreContact<double> tyre;
  double ratio, factor;  ///< MountedDamper's
  const LawModel* law;
  FollowedLoop* loop;  ///< among its states; null: none is followed
  double* states;      ///< those at the last call of rates() where a loop is, by its z

  /// Forces at the last call of rates(), N.
  struct Forces {
    double damper, strut;
  };
  /// dy/dt with these parameters of the law, on the road as it is there. kFollows: there is a loop.
  template <std::size_t kSize, bool kFollows>
  [[gnu::always_inline]] inline Forces rates(const double* parameters, const FootMotion& foot,
                                             const double* y, double* dy) const {
    constexpr std::size_t kStates = kSize - 4;
    double z[kStates + 1]{}, dz[kStates + 1];
    for (std::size_t k = 0; k < kStates; ++k) z[k] = y[4 + k];
    if constexpr (kFollows) unfold<kStates>(z);

    // The damper's force, and the rates of its states.
    const double x = 0 + row[0] * y[0] + row[1] * y[1], v = 0 + row[0] * y[2] + row[1] * y[3];
    const double damper =
        ratio * (factor * law->flow(parameters, {ratio * x, ratio * v, 0}, z, dz));
    const double strut = damper + strut_resistance(stops, x, 0.0);
    if constexpr (kFollows) fold<kStates>(ratio * v, dz);
    for (std::size_t k = 0; k < kStates; ++k) dy[4 + k] = dz[k];

    // The motion under it and on this road.
    const double pushed = road_push(tyre, foot.height, foot.velocity);
    dy[0] = y[2];
    dy[1] = y[3];
    for (std::size_t i = 0; i < 2; ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += by_state[i][k] * y[k];
      sum += by_strut[i] * strut;
      dy[2 + i] = sum + by_tyre[i] * pushed;
    }
    return {damper, strut};
  }

 private:
  /// The loop's z in the place of its r.
  template <std::size_t kStates>
  [[gnu::always_inline]] inline void unfold(double* z) const {
    for (std::size_t k = 0; k < kStates; ++k) {
      if (4 + k == loop->place) {
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
      if (4 + k == loop->place)
        dz[k] = loop->path.folded_rate(dz[k], loop->along, {loop->m, loop->steep});
  }
};

}  // namespace dashpot
