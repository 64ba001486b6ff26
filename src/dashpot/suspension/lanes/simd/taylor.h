#pragma once
#include "dashpot/suspension/lanes/simd/quarter_car.h"
#include "dashpot/suspension/lanes/simd/tanh_neurons.h"

namespace dashpot {
namespace {

/// Taylor's series of the motion in time, for a ride that is smooth all along a sample: a damper
/// whose force is a polynomial of the strut's speed near that speed, no stops, friction, lift or
/// lags.
///
/// Time runs as s, the share of a sample of length dt. With x = [body, wheel, their speeds] and
///
///     x(s) = sum x_k s^k,   k = 0 ... n,         n = kOrder
///
/// the equations of motion give each term from those before it, with a_k of the accelerations:
///
///     heights  x_k+1 = dt / (k + 1) speeds_k,    speeds_k+1 = dt / (k + 1) a_k
///     a_k = A x_k + b F_k + c P_k                (QuarterCarLanes::acceleration)
///
/// P_k are the terms of the road's push, a cubic in s (RoadPush). F_k are those of the damper's
/// force: the damper gives f_j of F = sum f_j w^j, where w = m_1 s + m_2 s^2 + ... is how far the
/// strut's speed has moved, and composed() collects the powers of s in it (Faa di Bruno's formula).
///
/// Error and step: the last term that is kept, x_n s^n, stands for what the series leaves out. A
/// step ends where it reaches the tolerance, found before the step is taken, so that none is
/// refused: A. Jorba, M. Zou, Exp. Math. 14 (2005) 99-117. One step is one expansion of the damper.
template <class Damper>
class TaylorSteps {
  using Car = QuarterCarLanes<Damper>;
  using State = typename Car::State;
  static constexpr std::size_t kOrder = Damper::kTerms;  ///< n, of heights and speeds

  static_assert(kOrder == 6,
                "composed() has terms 0 to 5 of the force; length() raises to power 6");

 public:
  TaylorSteps(const LaneRide& ride, Car& car) : ride_(ride), car_(car) {}

  void begin(State&) {}
  /// Forces at the start of a sample, after the command has changed in some lanes.
  void refresh(const State& state, const Lane*, LaneMask changed, const RoadPush* road) {
    keep(state.x, damper_at(state.x), road->node[0], changed);
  }
  /// At the present state: the damper's force, N, and the accelerations of the coordinates, m/s^2.
  Lane force(std::size_t) const { return force_; }
  const Lane* acceleration() const { return acceleration_; }

  /// Over one sample in these lanes, all of which reach its end: in as many steps as the lane needs
  /// that needs most. The others take steps of length 0 meanwhile.
  LaneMask step(State& state, const Lane*, const RoadPush* roads, LaneMask riding) {
    const RoadPush& road = *roads;
    Lane done{}, left = riding ? all(1) : Lane{};
    do {
      // Terms of the series around the present state, and how far they carry.
      Lane x[kOrder + 1][4];
      if (!known_) damper_at(state.x);
      car_.damper.expand(damper_);
      expand(state.x, road, done, x);
      const Lane share = length(x, left);

      // The series at the end of the step, by Horner's rule.
      for (std::size_t i = 0; i < 4; ++i) {
        Lane sum = x[kOrder][i];
        for (std::size_t k = kOrder; k-- > 0;) sum = x[k][i] + share * sum;
        state.x[i] = sum;
      }
      known_ = false;

      // What is left of the sample, exactly 0 where the step reached its end.
      steps += left > 0 ? all(1) : Lane{};
      left = share < left ? left - share : Lane{};
      done += share;
    } while (any(left > 0));

    // Forces at the end, which the controller and the measures see.
    keep(state.x, damper_at(state.x), road.node[2], riding);
    return riding;
  }

  LaneMask missed{};  ///< lanes in which some step was too short to meet the tolerance
  Lane steps{};       ///< taken in each lane

 private:
  /// The damper's force, N, at the present velocity, which it knows then. Kept out of line: inlined
  /// copies may round differently, and a lane's bits must not depend on the place it is called
  /// from.
  [[gnu::noinline]] Lane damper_at(const Lane* x) {
    if (!known_) car_.damper.move_to(x[2] - x[3]);
    known_ = true;
    return car_.damper.respond();
  }
  void keep(const Lane* x, Lane force, Lane road, LaneMask which) {
    force_ = which ? force : force_;
    for (std::size_t k = 0; k < 2; ++k)
      acceleration_[k] = which ? car_.acceleration(k, x, force, road) : acceleration_[k];
  }
  /// Terms x_k of the series around a state at the share `begin` of the sample.
  void expand(const Lane* from, const RoadPush& road, Lane begin, Lane (&x)[kOrder + 1][4]) const {
    const double dt = ride_.sample_time;
    Lane push[kOrder]{}, moved[kOrder], force[kOrder];
    road.expand(begin, push);
    for (std::size_t i = 0; i < 4; ++i) x[0][i] = from[i];

#pragma GCC unroll 8
    for (std::size_t k = 0; k < kOrder; ++k) {
      moved[k] = x[k][2] - x[k][3];
      force[k] = composed(k, moved);

      // Each term of heights and speeds from the one before it.
      const double share = dt / static_cast<double>(k + 1);
      for (std::size_t i = 0; i < 2; ++i) {
        x[k + 1][i] = share * x[k][2 + i];
        x[k + 1][2 + i] = share * car_.acceleration(i, x[k], force[k], push[k]);
      }
    }
  }
  /// F_k, N, from the damper's f_j and the terms m of the strut's speed: what multiplies s^k in
  /// sum f_j (m_1 s + m_2 s^2 + ...)^j.
  [[gnu::always_inline]] Lane composed(std::size_t k, const Lane* m) const {
    const Lane* f = damper_;
    switch (k) {
      case 0:
        return f[0];
      case 1:
        return f[1] * m[1];
      case 2:
        return f[1] * m[2] + f[2] * (m[1] * m[1]);
      case 3:
        return f[1] * m[3] + m[1] * (2 * f[2] * m[2] + f[3] * (m[1] * m[1]));

      case 4: {
        const Lane square = m[1] * m[1];
        return f[1] * m[4] + f[2] * (2 * m[1] * m[3] + m[2] * m[2]) +
               square * (3 * f[3] * m[2] + f[4] * square);
      }

      default: {  // 5
        const Lane square = m[1] * m[1];
        return f[1] * m[5] + 2 * f[2] * (m[1] * m[4] + m[2] * m[3]) +
               3 * f[3] * m[1] * (m[1] * m[3] + m[2] * m[2]) +
               square * m[1] * (4 * f[4] * m[2] + f[5] * square);
      }
    }
  }
  /// Share of the sample after which the last term is within the tolerance; `left` where that is
  /// more than is left. A tolerance that asks for less than kLeast is missed.
  Lane length(const Lane (&x)[kOrder + 1][4], Lane left) {
    constexpr double kLeast = 1.0 / 256;

    // The last term over a whole sample, and what it may be; heights and speeds each by their
    // greatest.
    const auto greatest = [&](std::size_t k, std::size_t i) {
      return fmax(fabs(x[k][i]), fabs(x[k][i + 1]));
    };
    const auto allowed = [&](std::size_t i) {
      return ride_.absolute_tolerance +
             ride_.relative_tolerance * (greatest(0, i) + greatest(1, i));
    };
    const Lane heights = greatest(kOrder, 0), speeds = greatest(kOrder, 2),
               heights_may = allowed(0), speeds_may = allowed(2);

    // All that is left in one step, where the term is small enough at its end.
    const Lane square = left * left, power = square * square * square;
    const LaneMask whole = (heights * power <= heights_may) & (speeds * power <= speeds_may);
    if (!any(~whole)) return left;

    // Else the share at which it would just be: off^(-1/6), for which off^(-1/5), which is shorter,
    // stands since off > 1.
    const Lane off = fmax(heights / heights_may, speeds / speeds_may);
    const Lane shorter = fmin(fmax(0.9 * about_fifth_root_below(off), kLeast), left);
    missed = missed | (~whole & (shorter <= kLeast) & (left > kLeast));
    return whole ? left : shorter;
  }

  const LaneRide& ride_;
  Car& car_;
  typename Damper::Polynomial damper_;  ///< around the velocity at which it was expanded
  bool known_ = false;                  ///< the damper knows it at the present velocity
  Lane force_{}, acceleration_[2]{};
};

}  // namespace
}  // namespace dashpot
