#include "dashpot/suspension/bound/certificate.h"

#include <cmath>

namespace dashpot {
namespace {

/// A piece of an edge of a range: between two displacements and two velocities the force is
/// straight in either.
struct EdgePatch {
  Interval x[2], v[2], force[2][2];                 ///< force: at an x and a v
  bool from_infinity = false, to_infinity = false;  ///< in v: on and on
};

/// Not above a parabola in the way s from 0 to 1 with these Bernstein coefficients.
double parabola_least(const std::array<Interval, 3>& p, const EdgePatch& patch) {
  const Interval square = p[0] - Interval(2) * p[1] + p[2], rise = Interval(2) * (p[1] - p[0]);

  // Not below its lowest point, wherever that lies, nor below its Bernstein coefficients.
  double low = -INFINITY;
  if (square.low > 0) low = (p[0] - rise * rise / (Interval(4) * square)).low;
  if (!patch.from_infinity && !patch.to_infinity)
    low = std::max(low, std::min({p[0].low, p[1].low, p[2].low}));

  // A half line: a parabola that opens upwards and rises all the way.
  const Interval rise_at_end = Interval(2) * (p[2] - p[1]);
  if (patch.to_infinity && square.low >= 0 && rise.low >= 0) low = std::max(low, p[0].low);
  if (patch.from_infinity && square.low >= 0 && rise_at_end.high <= 0)
    low = std::max(low, p[2].low);
  return std::isnan(low) ? -INFINITY : low;
}

/// A limit over a patch, q = a F + b v + x x, where a and b are straight too: a parabola in either
/// way.
class LimitOnPatch {
 public:
  LimitOnPatch(const ForceLimit& limit, const EdgePatch& patch) : patch_(patch) {
    for (int i = 0; i < 2; ++i) {
      const Interval& x = patch.x[i];
      for (int j = 0; j < 2; ++j) {
        a_[i][j] = Interval(limit.ff) * patch.force[i][j] + Interval(limit.fv) * patch.v[j] +
                   Interval(limit.fx) * x + limit.f;
        b_[i][j] = Interval(limit.vv) * patch.v[j] + Interval(limit.vx) * x + limit.v;
      }
      along_x_[i] = Interval(limit.x) * x;
    }
  }

  /// Its Bernstein coefficients along v: at the first displacement, the second, or the coefficient
  /// between these (i = 0, k = 1).
  std::array<Interval, 3> along_velocity(int i, int k) const {
    const Interval fixed = half(along_x_[i] + along_x_[k]);
    const auto with = [&](int j, int l) { return half(product(i, k, j, l) + product(k, i, j, l)); };
    return {with(0, 0) + fixed, half(with(0, 1) + with(1, 0)) + fixed, with(1, 1) + fixed};
  }

 private:
  static Interval half(const Interval& a) { return Interval(0.5) * a; }
  Interval product(int i, int k, int j, int l) const {
    return a_[i][j] * patch_.force[k][l] + b_[i][j] * patch_.v[l];
  }

  const EdgePatch& patch_;
  Interval a_[2][2], b_[2][2], along_x_[2];
};

/// A lower bound of a limit on a patch. Where what lies between the displacements makes it less
/// than the goal, by halves of the patch.
double proven_least(const ForceLimit& limit, const EdgePatch& patch, double goal, int halvings) {
  // At either displacement; between them it is not below the middle coefficients.
  const LimitOnPatch on(limit, patch);
  const bool flat = patch.x[0].low == patch.x[1].high;
  const double first = parabola_least(on.along_velocity(0, 0), patch);
  if (flat) return first;
  const double ends = std::min(first, parabola_least(on.along_velocity(1, 1), patch));
  const double least = std::min(ends, parabola_least(on.along_velocity(0, 1), patch));
  if (least >= goal || least >= ends || halvings == 0) return least;

  // The halves: any displacement between will do, but both must have the same.
  const Interval middle = 0.5 * (patch.x[0].low + patch.x[1].high);
  const Interval share = (middle - patch.x[0]) / (patch.x[1] - patch.x[0]);
  EdgePatch lower = patch, upper = patch;
  lower.x[1] = upper.x[0] = middle;
  for (int j = 0; j < 2; ++j)
    lower.force[1][j] = upper.force[0][j] =
        patch.force[0][j] + share * (patch.force[1][j] - patch.force[0][j]);
  return std::min(proven_least(limit, lower, goal, halvings - 1),
                  proven_least(limit, upper, goal, halvings - 1));
}

/// Calls look(patch) for all of both edges of a range.
template <class Look>
void for_each_patch(const ForceRange& range, Look look) {
  const auto along = [&](const auto& v, double from, double to, const auto& force) {
    for (std::size_t k = 0; k + 1 < v.size(); ++k)
      look(EdgePatch{{from, to},
                     {v[k], v[k + 1]},
                     {{force(0, k), force(0, k + 1)}, {force(1, k), force(1, k + 1)}},
                     k == 0 && !range.ends,
                     k + 2 == v.size() && !range.ends});
  };
  for (const bool upper : {false, true}) {
    if (range.sides.empty())
      along(range.velocity, 0, 0,
            [&](std::size_t, std::size_t k) { return upper ? range.greatest(k) : range.least(k); });
    for (const RangeSide& side : range.sides)
      for (std::size_t p = 0; p + 1 < side.displacement.size(); ++p)
        along(range.velocity, side.displacement[p], side.displacement[p + 1],
              [&](std::size_t i, std::size_t k) {
                return upper ? side.greatest(p + i, k) : side.least(p + i, k);
              });
  }
}

/// A lower bound of a limit on a range, at all displacements; minus infinity where there is none.
/// On the edges: inside the range it is not less, being concave in F.
double proven_least(const ForceRange& range, const ForceLimit& limit) {
  if (!(limit.ff <= 0)) return -INFINITY;
  if (range.sides.empty() && limit.has_displacement()) return -INFINITY;

  // What it is at the corners, which nothing proves: what comes near that is good enough.
  double corner = INFINITY;
  for_each_patch(range, [&](const EdgePatch& patch) {
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        corner = std::min(corner, limit.at(patch.x[i].low, patch.v[j].low, patch.force[i][j].low));
  });
  constexpr double kNear = 1e-3;
  const double goal = corner - kNear * std::abs(corner);

  constexpr int kHalvings = 5;
  double least = INFINITY;
  for_each_patch(range, [&](const EdgePatch& patch) {
    least = std::min(least, proven_least(limit, patch, goal, kHalvings));
  });
  return least;
}

// Polynomials in time by their Bernstein coefficients: where these are at least 0, so is the
// polynomial, from the start of its piece to the end.

template <std::size_t N>
using Bernstein = std::array<Summed, N>;

/// Rows of Pascal's triangle, up to the highest degree here.
constexpr double kBinomial[5][5] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};

template <std::size_t N, std::size_t M>
Bernstein<N + M - 1> product(const Bernstein<N>& a, const Bernstein<M>& b) {
  Bernstein<N + M - 1> out;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < M; ++j)
      out[i + j] += scaled(kBinomial[N - 1][i] * kBinomial[M - 1][j], a[i] * b[j]);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = scaled(1 / kBinomial[N + M - 2][k], out[k]);
  return out;
}

/// The same polynomial with the coefficients of a higher degree.
template <std::size_t N, std::size_t M>
Bernstein<N> raised(const Bernstein<M>& p) {
  constexpr std::size_t kMore = N - M;
  Bernstein<N> out;
  for (std::size_t k = 0; k < N; ++k) {
    for (std::size_t i = k > kMore ? k - kMore : 0; i < M && i <= k; ++i)
      out[k] += scaled(kBinomial[M - 1][i] * kBinomial[kMore][k - i], p[i]);
    out[k] = scaled(1 / kBinomial[N - 1][k], out[k]);
  }
  return out;
}

/// sum += factor p, p written with the higher degree of the sum.
template <std::size_t N, std::size_t M>
void add(Bernstein<N>& sum, const Summed& factor, const Bernstein<M>& p) {
  static_assert(M <= N);
  if (factor.size == 0) return;  // as much of a car's motion is
  if constexpr (M == N) {
    for (std::size_t k = 0; k < N; ++k) sum[k] += factor * p[k];
  } else if constexpr (M == 1) {
    const Summed same = factor * p[0];
    for (Summed& one : sum) one += same;
  } else {
    add(sum, factor, raised<N>(p));
  }
}

/// Whether a symmetric form is positive definite: eliminated from the last row upwards, each pivot
/// is above 0. Its lower triangle is read.
template <std::size_t N>
bool is_positive(std::array<std::array<Interval, N>, N> form) {
  for (std::size_t k = N; k-- > 0;) {
    if (!(form[k][k].low > 0)) return false;
    for (std::size_t i = 0; i < k; ++i) {
      const Interval share = form[k][i] / form[k][k];
      for (std::size_t j = 0; j <= i; ++j) form[i][j] -= share * form[k][j];
    }
  }
  return true;
}

bool is_moderate(double number) { return std::abs(number) < Summed::kGreatest; }
bool is_moderate(const StateForm& form) {
  return std::ranges::all_of(form.values, [](double entry) { return is_moderate(entry); });
}
bool is_moderate(const ForceLimit& limit) {
  return std::ranges::all_of(std::array{limit.ff, limit.fv, limit.vv, limit.f, limit.v, limit.fx,
                                        limit.vx, limit.x, limit.one},
                             [](double coefficient) { return is_moderate(coefficient); });
}

}  // namespace

/// V over a piece: Bernstein coefficients of each entry of P in [j][i], i <= j.
struct Certificate::Cubic {
  std::array<std::array<std::array<double, 4>, 5>, 5> entries;
  std::array<std::array<Bernstein<5>, 5>, 5> raised{};  // the same, written with degree 4

  Bernstein<4> at(std::size_t i, std::size_t j) const {
    const std::array<double, 4>& p = i <= j ? entries[j][i] : entries[i][j];
    return {p[0], p[1], p[2], p[3]};
  }
  const Bernstein<5>& raised_at(std::size_t i, std::size_t j) const {
    return i <= j ? raised[j][i] : raised[i][j];
  }
  /// Differences lose next to nothing to roundings, which are large beside them.
  Bernstein<3> rate(std::size_t i, std::size_t j, const Interval& duration) const {
    const std::array<double, 4>& p = entries[j][i];
    const Interval factor = Interval(3) / duration;
    return {factor * (Interval(p[1]) - p[0]), factor * (Interval(p[2]) - p[1]),
            factor * (Interval(p[3]) - p[2])};
  }
};

Certificate::Certificate(const Plant& plant, const SampledPlant& car, const ForceRange& range,
                         const RideIndex& index, const LimitCourse& course)
    : car_(car), index_(index), course_(course), cell_(car.cells() - 1), into_(car.step()) {
  for (ForceLimit limit : course.limits) {
    const double least = proven_least(range, limit);
    limit.one = -least;
    limits_.push_back(is_moderate(limit) ? std::optional(limit) : std::nullopt);
  }
  set_car(plant);
  if (!car_is_moderate() || !is_moderate(index.comfort) || !is_moderate(index.holding))
    std::ranges::fill(limits_, std::nullopt);
}

void Certificate::set_car(const Plant& plant) {
  const Tyre& tyre = plant.tyres[0];
  const Strut& strut = plant.struts[0];
  stiffness_ = tyre.stiffness;
  damping_ = tyre.damping;

  // M q'' = -K q - C q' - row F + tyre P, by Cramer's rule for M.
  const auto& m = plant.mass;
  const Summed scale = Interval(1) / (Interval(m[0]) * m[3] - Interval(m[1]) * m[2]);
  const Summed over_mass[2][2] = {{scale * m[3], scale * -m[1]}, {scale * -m[2], scale * m[0]}};
  for (std::size_t i = 0; i < 2; ++i) {
    motion_[i][i + 2] = 1;
    for (std::size_t l = 0; l < 2; ++l) {
      for (std::size_t j = 0; j < 2; ++j) {
        const Summed row = Summed(tyre.row[l]) * tyre.row[j];
        motion_[i + 2][j] -=
            over_mass[i][l] * (Summed(plant.stiffness[2 * l + j]) + row * stiffness_);
        motion_[i + 2][j + 2] -=
            over_mass[i][l] * (Summed(plant.damping[2 * l + j]) + row * damping_);
      }
      by_force_[i + 2] -= over_mass[i][l] * strut.row[l];
      by_push_[i + 2] += over_mass[i][l] * tyre.row[l];
    }
    speed_[i + 2] = strut.row[i];
    displacement_[i] = strut.row[i];
    tyre_force_[i] = -stiffness_ * tyre.row[i];
    tyre_force_[i + 2] = -damping_ * tyre.row[i];
  }

  // The body's acceleration is a sum of these rows.
  for (std::size_t l = 0; l < 2; ++l) {
    const Summed share = strut.body_row[l];
    for (std::size_t j = 0; j < 4; ++j) acceleration_[j] += share * motion_[l + 2][j];
    acceleration_by_force_ += share * by_force_[l + 2];
    acceleration_by_push_ += share * by_push_[l + 2];
  }
}

bool Certificate::car_is_moderate() const {
  const auto are = [](const auto& numbers) {
    return std::ranges::all_of(numbers, [](const Summed& a) { return is_moderate(a.size); });
  };
  return std::ranges::all_of(motion_, are) && are(by_force_) && are(by_push_) &&
         are(acceleration_) && are(tyre_force_) && are(speed_) && are(displacement_) &&
         are(std::array{acceleration_by_force_, acceleration_by_push_, stiffness_, damping_});
}

bool Certificate::back_to(double into, const StateForm& value, const StateForm& slope,
                          const StateForm& slope_at_end) {
  if (!limit(cell_) || !(into >= 0 && into < into_)) return false;
  if (!is_moderate(value) || !is_moderate(slope) || !is_moderate(slope_at_end)) return false;

  // Both ends are exact, which makes V continuous; what lies between may be any doubles.
  Cubic cubic;
  const double third = (into_ - into) / 3;
  for (std::size_t j = 0; j < 5; ++j)
    for (std::size_t i = 0; i <= j; ++i) {
      cubic.entries[j][i] = {value(i, j), value(i, j) + third * slope(i, j),
                             value_(i, j) - third * slope_at_end(i, j), value_(i, j)};
      add(cubic.raised[j][i], 1, cubic.at(i, j));
    }
  if (!holds(cubic, into, into_)) return false;

  // The place that is proven; at the start of a cell, the end of the one before.
  value_ = value;
  into_ = into;
  if (into == 0 && cell_ > 0) {
    --cell_;
    into_ = car_.step();
  } else if (into == 0) {
    cell_ = car_.cells();  // all of the time
  }
  return true;
}

bool Certificate::holds(const Cubic& value, double from, double to) const {
  const Interval duration = Interval(to) - Interval(from);
  const ForceLimit& limit = *limits_[cell_ / course_.block];
  const Summed comfort = index_.comfort, holding = index_.holding, half = 0.5;
  const Summed &a_f = acceleration_by_force_, &a_w = acceleration_by_push_;

  // The tyre's push by the road, a straight line.
  const auto& road = car_.road(cell_);
  const auto push_at = [&](double into) {
    return stiffness_ * (Summed(road.height) + Summed(road.slope) * into) + damping_ * road.slope;
  };
  const Bernstein<2> push{push_at(from), push_at(to)};
  if (!is_moderate(push[0].size) || !is_moderate(push[1].size)) return false;

  // The form's column of the force: by the state, by 1 and by itself.
  const Summed force_force = comfort * a_f * a_f - limit.ff;
  if (!(force_force.interval().low > 0)) return false;
  std::array<Bernstein<4>, 5> force{};
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t l = 2; l < 4; ++l) add(force[i], by_force_[l], value.at(i, l));
    const Summed fixed = i < 4 ? comfort * acceleration_[i] * a_f -
                                     half * (speed_[i] * limit.fv + displacement_[i] * limit.fx)
                               : -(half * limit.f);
    add(force[i], fixed, Bernstein<1>{1});
  }
  add(force[4], comfort * a_w * a_f, push);

  // A law that takes this column away but for what curves: any law would do.
  std::array<Bernstein<2>, 5> law;
  for (std::size_t i = 0; i < 5; ++i) {
    law[i] = {-force[i].front().value / force_force.value,
              -force[i].back().value / force_force.value};
    if (!is_moderate(law[i].front().size) || !is_moderate(law[i].back().size)) return false;
  }

  // The form over the state and 1, with the force counted from that law, and its column then.
  std::array<std::array<Bernstein<5>, 6>, 6> form{};
  for (std::size_t j = 0; j < 5; ++j)
    for (std::size_t i = 0; i <= j; ++i) {
      Bernstein<5>& entry = form[j][i];
      add(entry, 1, value.rate(i, j, duration));
      for (std::size_t l = 0; l < 4; ++l) {
        if (j < 4) add(entry, motion_[l][j], value.raised_at(i, l));
        if (i < 4) add(entry, motion_[l][i], value.raised_at(l, j));
        if (l < 2) continue;  // a push moves no place at once
        if (j == 4) add(entry, by_push_[l], product(value.at(i, l), push));
        if (i == 4) add(entry, by_push_[l], product(value.at(l, j), push));
      }

      // The index less the limit.
      if (j < 4) {
        add(entry,
            comfort * acceleration_[i] * acceleration_[j] +
                holding * tyre_force_[i] * tyre_force_[j] - limit.vv * speed_[i] * speed_[j] -
                half * limit.vx * (speed_[i] * displacement_[j] + displacement_[i] * speed_[j]),
            Bernstein<1>{1});
      } else if (i < 4) {
        add(entry, comfort * acceleration_[i] * a_w + holding * tyre_force_[i], push);
        add(entry, -(half * (speed_[i] * limit.v + displacement_[i] * limit.x)), Bernstein<1>{1});
      } else {
        add(entry, comfort * a_w * a_w + holding, product(push, push));
        add(entry, -limit.one, Bernstein<1>{1});
      }

      // F = law z + what is left.
      add(entry, 1, product(force[i], law[j]));
      add(entry, 1, product(force[j], law[i]));
      add(entry, force_force, product(law[i], law[j]));
    }
  for (std::size_t i = 0; i < 5; ++i) {
    add(form[5][i], 1, force[i]);
    add(form[5][i], force_force, law[i]);
  }
  add(form[5][5], force_force, Bernstein<1>{1});

  // Positive definite at every coefficient.
  for (std::size_t k = 0; k < 5; ++k) {
    std::array<std::array<Interval, 6>, 6> at;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j <= i; ++j) at[i][j] = form[i][j][k].interval();
    if (!is_positive(at)) return false;
  }
  return true;
}

std::optional<double> Certificate::bound() const {
  if (cell_ != car_.cells()) return {};
  return value_(4, 4);
}

}  // namespace dashpot
