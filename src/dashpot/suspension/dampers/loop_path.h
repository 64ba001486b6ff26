#pragma once
#include <cstddef>

// A hysteresis loop's state by the way along the branches of its loop, so that a loop which has
// settled asks for no short steps. simulate() takes this text with Number = double, rides in lanes
// with a vector that holds a number per vehicle.
//
// z' = a(z) w, w m/s the speed that drives the loop, settles at +-z_max within micrometres of
// travel, so within microseconds: explicit steps of z are as short. In the direction d = +-1 of the
// motion, z = d z_max m, and along a branch, where d w = s >= 0,
//
//   m' = rate s slope(m),   slope(m) = 1 - m^n                    for m > 0 (the branch settles)
//                                    = 1 + (2 sigma - 1) |m|^n    for m < 0
//
// With m = tanh r for m > 0, and m = r for m < 0, this is smooth and slow, however near m is to 1:
//
//   r' = rate s slope(m) dr/dm,   dr/dm = cosh^2 r   for r > 0,   1   for r < 0
//
// (n = 2: r' = rate s; r is the way that was travelled.) Where the motion turns, s = 0, the loop
// goes on along another branch: d changes its sign, m too. A step ends there: one that reaches over
// a turn is refused, and tried again up to where a straight line has s = 0. Where no direction can
// be told, since the motion stands or creeps around a turn, r = m, in place of a branch's equation
// stands the law's own, which holds for both directions, and the error's control does the rest.
namespace dashpot {

/// z_max m (or what z is counted in), rate 1/m, sigma and n of the loop above.
template <class Number>
struct LoopShape {
  Number z_max, rate, sigma, n;
};

/// Of one loop, or of one per lane. Kind gives Number; any(mask); exp_of_twice(r), e^(2 r);
/// arctanh(m, where), where a mask is set; slope(shape, m).
template <class Kind>
class LoopPath {
 public:
  using Number = typename Kind::Number;
  using Mask = decltype(Number{} < Number{});
  using Shape = LoopShape<Number>;
  static constexpr bool kExists = true;
  /// The r at which z has settled to 3e-12 of itself; beyond, it is nothing but rounding.
  static constexpr double kSettled = 14;

  LoopPath() = default;
  /// tolerance: of z. `varies`: where the loop is another one at another current; the law's own
  /// equation serves there, as it does where the loop has no size.
  LoopPath(const Shape& shape, Number tolerance, Mask varies)
      : shape_(shape), exists_((shape.z_max > 0) & (shape.z_max < kMostSize) & !varies) {
    shape_.z_max = exists_ ? shape.z_max : kOne;
    turn_ = 2 * kTurnShare * tolerance / (shape.rate * shape_.z_max);
  }

  /// r of z where no branch is known, as before the first step.
  Number folded(Number z) {
    on_branch_ = Mask{};
    return side_ * z / shape_.z_max;
  }

  /// A place on the loop: m, and how steep r is there, dr / dm.
  struct Place {
    Number m, steep;
  };
  [[gnu::always_inline]] Place place(Number r) const {
    Place at{r, kOne};
    if (!Kind::any(on_branch_)) return at;
    const Mask rising = on_branch_ & (r > 0);
    const Number e = Kind::exp_of_twice(r < kSettled ? r : kSettled + Number{}), more = 1 + e,
                 share = 1 / (e * more);
    at.m = rising ? 1 - 2 * (share * e) : r;
    at.steep = rising ? 0.25 * (more * more) * (more * share) : at.steep;
    return at;
  }
  Number unfolded(const Place& at) const { return side_ * shape_.z_max * at.m; }
  /// The speed w along the present branch: s.
  Number along(Number travel) const { return side_ * travel; }
  /// r' where the law has z'. A branch's own equation goes on beyond a turn, as no law does: what
  /// is refused there is smooth, so that the turn can be found from it.
  [[gnu::always_inline]] Number folded_rate(Number dz, Number along, const Place& at) const {
    return on_branch_ ? shape_.rate * along * Kind::slope(shape_, at.m) * at.steep
                      : side_ / shape_.z_max * dz;
  }

  /// The error of r as one of z, and what it is measured against.
  Number error(Number off, Number steep, Number steep_at_end) const {
    return off * shape_.z_max / (steep < steep_at_end ? steep : steep_at_end);
  }
  Number size(Number otherwise) const { return exists_ ? shape_.z_max : otherwise; }

  /// The speed along the branch, s, in a try of a step: at its start, at kEarly and kLate of its
  /// length, and at its end.
  struct Speeds {
    Number from, early, late, to;
  };
  static constexpr double kEarly = 0.3, kLate = 0.8;

  /// What a try of a step of length h, s, has met.
  struct Met {
    Mask over{};     ///< the motion turned within it: it must end there
    Mask stuck{};    ///< and stood so at its start already: no branch can be told
    Mask turned{};   ///< its end is where the motion turns
    Mask free{};     ///< its end is on a branch, and its start was on none
    Number until{};  ///< s, the length at which the motion turns, by a straight line
  };
  /// A step of length `least` is not refused.
  [[gnu::always_inline]] Met meet(const Speeds& s, Number h, double least) const {
    Met met;
    const Number from = s.from, to = s.to;
    const Number fall = (from - to) / h, near = turn_ * (fall < 0 ? -fall : fall);
    const Mask at_end = to * to <= near, within = on_branch_ & (h > least);
    const Mask beyond = within & (to < 0) & !at_end;
    const Mask early = dips(s, s.early, kEarly, h), late = dips(s, s.late, kLate, h),
               dipped = within & !beyond & (early | late);
    met.over = beyond | dipped;
    met.stuck = beyond & ((from <= 0) | (from * from <= 4 * near) | (refused_ > kMostRefused));
    met.until = dipped ? 0.5 * h : h * from / (from - to);
    met.turned = on_branch_ & !met.over & at_end & (fall > 0);
    met.free = exists_ & !on_branch_ & (to * to > kClear * near);
    return met;
  }

  /// Whether the parabola through `from`, `middle` at this share of the step, and `to` falls below
  /// 0 in between, and for how long: two turns that its ends do not show. Of a parabola with the
  /// least value -D and the curvature c, the way below 0 is (4 / 3) h D sqrt(D / c).
  [[gnu::always_inline]] Mask dips(const Speeds& s, Number middle, double share, Number h) const {
    const Number rise = s.to - s.from,
                 bend = (share * rise - (middle - s.from)) / (share * (1 - share)),
                 start = rise - bend;
    const Number lowest = start * start / (4 * bend) - s.from;  // D
    return (bend > 0) & (start < 0) & (-start < 2 * bend) & (lowest > 0) &
           (7 * h * h * lowest * lowest * lowest > turn_ * turn_ * bend);
  }

  /// The branches after a try, by what it met and whether it was accepted; r at the present state.
  /// Where r is another one than before, the slope there is, too: returned.
  Mask go_on(const Met& met, Number to, Mask accepted, Number& r) {
    refused_ = accepted ? Number{} : refused_ + (met.over ? kOne : Number{});
    r = (accepted & on_branch_ & (r > kSettled)) ? kSettled + Number{} : r;

    const Mask turned = met.turned & accepted, free = met.free & accepted,
               stuck = met.stuck & !accepted, changed = turned | free | stuck;
    if (!Kind::any(changed)) return changed;

    // m, mirrored where the motion goes the other way.
    Number m = place(r).m;
    const Mask mirrored = turned | (free & (to < 0));
    m = mirrored ? -m : m;
    side_ = mirrored ? -side_ : side_;

    // r of m on the branch that each is on now.
    on_branch_ = (on_branch_ | free) & !stuck;
    const Mask rising = on_branch_ & changed & (m > 0);
    r = changed ? m : r;
    if (Kind::any(rising)) {
      const Number way = Kind::arctanh(m < kAlmostOne ? m : kAlmostOne + Number{}, rising);
      r = rising ? (way < kSettled ? way : kSettled + Number{}) : r;
    }
    return changed;
  }

 private:
  static constexpr Number kOne = Number{} + 1;
  /// Of the tolerance, what a turn that is met a little too early or late may cost.
  static constexpr double kTurnShare = 0.1;
  /// In squares of the speed at which the motion counts as turning.
  static constexpr double kClear = 100;
  static constexpr double kMostRefused = 6, kMostSize = 1e100;
  static constexpr double kAlmostOne = 1 - 1e-15;

  Shape shape_{};
  Mask exists_{};       ///< where there is a loop
  Mask on_branch_{};    ///< where r is the way along a branch
  Number side_ = kOne;  ///< d
  Number turn_{};       ///< m: s^2 at a turn, over its fall, that may be missed
  Number refused_{};    ///< tries since the last accepted step that reached over a turn
};

}  // namespace dashpot
