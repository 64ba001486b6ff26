#pragma once
#include <type_traits>

#include "dashpot/suspension/lanes/ride.h"
#include "dashpot/suspension/lanes/simd/lane_math.h"

namespace dashpot {
namespace {

/// For dampers without a hysteresis loop: nothing to do.
struct NoLoop {
  static constexpr bool kExists = false;
  struct Met {};
  struct Place {};
};

/// A hysteresis loop's state by the way along its branch (hysteresis_path.h has the mathematics):
/// r instead of z, in lanes that are on a branch, so that a loop that has settled asks for no
/// short steps. Lanes that are not keep r = d z / z_max, the law's own equation, which holds
/// wherever the motion may turn.
///
/// Law gives, of its parameters P: kState, the place of z among the states; travel(v, dz), m/s, the
/// speed w that drives the loop; z_max(p), m; rate(p), 1/m, and slope(p, m): m' = rate slope w along
/// a branch; kShape, the places of the parameters that they depend on.
template <class Law>
class LoopLanes {
  using P = typename Law::Parameters;

 public:
  static constexpr bool kExists = true;
  static constexpr std::size_t kState = Law::kState;

  /// `varies`: lanes in which the loop is another one at another current. They take no branch.
  LoopLanes() = default;
  LoopLanes(const LaneRide& ride, const P& parameters, LaneMask varies) : law_(parameters) {
    const Lane z_max = Law::z_max(&parameters);
    exists_ = (z_max > 0) & (z_max < kMostSize) & ~varies;
    z_max_ = exists_ ? z_max : all(1);
    const Lane tolerance = ride.absolute_tolerance + ride.relative_tolerance * z_max_;
    rate_ = Law::rate(&parameters);
    turn_ = 2 * kTurnShare * tolerance / (rate_ * z_max_);
  }

  /// r of a state z, before the first step.
  Lane folded(Lane z) const { return z / z_max_; }

  /// A place on the loop: m of z = d z_max m, and how steep r is there, dr / dm.
  struct Place {
    Lane m, steep;
  };
  /// Of r; beyond kSettled, m and its rate are nothing but rounding.
  Place place(Lane r) const {
    Place at{r, all(1)};
    if (!any(on_branch_)) return at;
    const LaneMask rising = on_branch_ & (r > 0);
    const Lane e = exp_of_twice<double>(fmin(r, kSettled)), more = 1 + e, share = 1 / (e * more);
    at.m = rising ? 1 - 2 * (share * e) : r;
    at.steep = rising ? 0.25 * (more * more) * (more * share) : at.steep;
    return at;
  }
  Lane unfolded(const Place& at) const { return side_ * z_max_ * at.m; }
  /// r' where the law has z' and the motion this speed along the branch: on a branch by the
  /// branch's own equation, which goes on where the motion turns and the law has another.
  Lane folded_rate(Lane dz, Lane along, const Place& at) const {
    return on_branch_ ? rate_ * along * Law::slope(&law_, at.m) * at.steep : side_ / z_max_ * dz;
  }

  /// The error of r as one of z, and what it is measured against.
  Lane error(Lane off, Lane steep, Lane steep_at_end) const {
    return off * z_max_ / fmin(steep, steep_at_end);
  }
  Lane size(Lane otherwise) const { return exists_ ? z_max_ : otherwise; }

  /// The speed along the present branch: that of its travel w, mirrored.
  Lane along(Lane v, const Lane* dz) const { return side_ * Law::travel(v, dz); }

  /// What a try of a step from speed `from` along the branch to `to`, `lowest` in between, has met.
  struct Met {
    LaneMask over{};    ///< the motion turned within it: it must end there
    LaneMask stuck{};   ///< and stood so at its start already: no branch can be told
    LaneMask turned{};  ///< its end is where the motion turns
    LaneMask free{};    ///< its end is on a branch, of a lane that was on none
    Lane until{};       ///< s, the length at which the motion turns, by a straight line
  };
  Met meet(Lane from, Lane to, Lane lowest, Lane h, double least) {
    Met met;
    const Lane fall = (from - to) / h, near = turn_ * fabs(fall);
    const LaneMask at_end = to * to <= near, within = on_branch_ & (h > least);
    const LaneMask beyond = within & (to < 0) & ~at_end,
                   dipped = within & (to >= 0) & (-2 * h * lowest > turn_);
    met.over = beyond | dipped;
    met.stuck = beyond & ((from <= 0) | (from * from <= 4 * near) | (refused_ > kMostRefused));
    met.until = dipped ? 0.5 * h : h * from / (from - to);
    met.turned = on_branch_ & ~met.over & at_end & (fall > 0);
    met.free = exists_ & ~on_branch_ & (to * to > kClear * near);
    return met;
  }

  /// The branches after a try, by what it met and whether it was accepted; r at the present state.
  /// Lanes in which r is another one than before need their slope again.
  LaneMask go_on(const Met& met, Lane to, LaneMask accepted, Lane& r) {
    refused_ = accepted ? Lane{} : refused_ + (met.over ? all(1) : Lane{});
    r = (accepted & on_branch_) ? fmin(r, kSettled) : r;

    const LaneMask turned = met.turned & accepted, free = met.free & accepted,
                   stuck = met.stuck & ~accepted, changed = turned | free | stuck;
    if (!any(changed)) return changed;

    // m, mirrored where the motion goes the other way.
    Lane m = place(r).m;
    const LaneMask mirrored = turned | (free & (to < 0));
    m = mirrored ? -m : m;
    side_ = mirrored ? -side_ : side_;

    // r of m on the branch that each is on now.
    on_branch_ = (on_branch_ | free) & ~stuck;
    const LaneMask rising = on_branch_ & changed & (m > 0);
    r = changed ? m : r;
    if (any(rising))
      for (std::size_t k = 0; k < kWidth; ++k)
        if (rising[k])
          r[k] = m[k] < kAlmostOne ? __builtin_fmin(__builtin_atanh(m[k]), kSettled) : kSettled;
    return changed;
  }
  /// Lanes whose last try was refused since the motion turned within it.
  LaneMask turning() const { return refused_ > 0; }

 private:
  /// Of the tolerance, what a turn that is met a little too early or late may cost.
  static constexpr double kTurnShare = 0.1;
  /// In squares of the speed at which the motion counts as turning.
  static constexpr double kClear = 100;
  static constexpr double kMostRefused = 6, kMostSize = 1e100;
  /// Where z has settled to 3e-12 of itself.
  static constexpr double kSettled = 14, kAlmostOne = 1 - 1e-15;

  P law_{};
  LaneMask exists_{};     ///< lanes in which the loop has a size that does not change
  LaneMask on_branch_{};  ///< lanes in which r is the way along a branch
  Lane side_ = all(1);    ///< d, the direction of the motion
  Lane z_max_{}, rate_{};
  Lane turn_{};  ///< m^2/s^2 of the speed at a turn, per m/s^2 at which it falls, that may be missed
  Lane refused_{};  ///< tries since the last accepted step in which the motion turned
};

template <class Law>
using LoopOf = std::conditional_t<Law::kExists, LoopLanes<Law>, NoLoop>;

}  // namespace
}  // namespace dashpot
