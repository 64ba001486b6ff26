#include "dashpot/suspension/bound/optimum.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dashpot {
namespace {

using State = SmallMatrix<5, 1>;  // [q, q', 1]
using Law = SmallMatrix<1, 5>;

/// A motion cell by cell.
struct Path {
  double sum = 0;  ///< the index's integral
  std::vector<State> states;
  std::vector<double> forces, shares;
};

double at(const SmallMatrix<1, 6>& row, const State& z) {
  double sum = 0;
  for (std::size_t i = 0; i < 5; ++i) sum += row(0, i) * z(i, 0);
  return sum;
}

/// The forces at the displacement that the damper has in the middle of a cell.
ForceCurves forces_at(const AffineCar& now, const ForceRange& range, const State& z) {
  return range.at(at(now.displacement, z));
}

/// Along cells under forces as choose(cell, state, softest, hardest) asks for, clipped to the
/// range.
template <class Choose>
Path run(const SampledPlant& car, const ForceRange& range, const RideIndex& index, Choose choose) {
  Path path;
  State z;
  z(kOnePlace, 0) = 1;
  for (std::size_t cell = 0; cell < car.cells(); ++cell) {
    // The force that is chosen, clipped to what the damper can give at this speed.
    const AffineCar now = car.over(cell);
    const double free = at(now.speed, z), by_force = now.speed(0, kForcePlace);
    const ForceCurves forces = forces_at(now, range, z);
    const double soft = forces.force_against(free, by_force, 0),
                 hard = forces.force_against(free, by_force, 1);
    const double force =
        std::clamp(choose(cell, z, free, by_force), std::min(soft, hard), std::max(soft, hard));

    // The outputs under this force, and what they add to the index.
    const double a = at(now.acceleration, z) + now.acceleration(0, kForcePlace) * force;
    const double w = at(now.tyre_force, z) + now.tyre_force(0, kForcePlace) * force;
    path.sum += car.step() * (index.comfort * a * a + index.holding * w * w);
    path.states.push_back(z);
    path.forces.push_back(force);
    path.shares.push_back(forces.share(free + by_force * force, force));

    // One cell further.
    SmallMatrix<6, 1> joint;
    for (std::size_t i = 0; i < 5; ++i) joint(i, 0) = z(i, 0);
    joint(kForcePlace, 0) = force;
    z = now.motion * joint;
  }
  return path;
}

/// A law per cell that is best when forces at an end of the range stay at that end.
std::vector<Law> sweep_back(const SampledPlant& car, const ForceRange& range,
                            const RideIndex& index, const Path& path) {
  std::vector<Law> laws(car.cells());
  SmallMatrix<5, 5> value;
  for (std::size_t cell = car.cells(); cell-- > 0;) {
    const AffineCar now = car.over(cell);
    const SmallMatrix<6, 6> form =
        car.step() * cost_form(now, index) + before_motion(value, now.motion);
    Law law;
    for (std::size_t j = 0; j < 5; ++j)
      law(0, j) = -form(kForcePlace, j) / form(kForcePlace, kForcePlace);
    laws[cell] = law;

    // Where the path's force is at an end of its range, the law keeps it there.
    const State& z = path.states[cell];
    const double free = at(now.speed, z), by_force = now.speed(0, kForcePlace);

    const double wanted = (law * z)(0, 0);
    const ForceCurves forces = forces_at(now, range, z);
    const double soft = forces.force_against(free, by_force, 0),
                 hard = forces.force_against(free, by_force, 1);
    const bool outside = wanted < std::min(soft, hard) || wanted > std::max(soft, hard);
    if (outside) {
      const bool is_hard = std::abs(wanted - hard) < std::abs(wanted - soft);
      const double force = is_hard ? hard : soft;
      const double share = is_hard ? 1 : 0, v = free + by_force * force;
      const auto [slope, offset] = forces.piece(v, share);
      const double by_place = forces.slope_by_displacement(v, share),
                   fixed = offset - by_place * at(now.displacement, z);
      for (std::size_t j = 0; j < 5; ++j)
        law(0, j) = (slope * now.speed(0, j) + by_place * now.displacement(0, j) +
                     (j == kOnePlace ? fixed : 0)) /
                    (1 - slope * by_force);
    }

    // The value one cell earlier, under that law.
    SmallMatrix<6, 5> lift;
    for (std::size_t i = 0; i < 5; ++i) {
      lift(i, i) = 1;
      lift(kForcePlace, i) = law(0, i);
    }
    value = transposed(lift) * (form * lift);
  }
  return laws;
}

Course course_of(const SampledPlant& car, Path path) {
  return {path.sum / (car.step() * static_cast<double>(car.cells())), std::move(path.shares)};
}

Path path_of_shares(const SampledPlant& car, const ForceRange& range, const RideIndex& index,
                    const std::vector<double>& shares) {
  return run(
      car, range, index, [&](std::size_t cell, const State& z, double free, double by_force) {
        return forces_at(car.over(cell), range, z).force_against(free, by_force, shares[cell]);
      });
}

}  // namespace

Course follow_shares(const SampledPlant& car, const ForceRange& range, const RideIndex& index,
                     const std::vector<double>& shares) {
  return course_of(car, path_of_shares(car, range, index, shares));
}

MotionSquares motion_under(const SampledPlant& car, const ForceRange& range,
                           const std::vector<double>& shares) {
  MotionSquares squares{};
  const Path path = path_of_shares(car, range, {}, shares);
  for (const State& z : path.states)
    for (std::size_t i = 0; i < squares.size(); ++i)
      squares[i] += z(i, 0) * z(i, 0) / static_cast<double>(car.cells());
  return squares;
}

Course improve(const SampledPlant& car, const ForceRange& range, const RideIndex& index,
               const Course& course) {
  constexpr double kLeastFall = 1e-6, kLeastStep = 1.0 / 128;
  constexpr int kMost = 100;
  Path path = path_of_shares(car, range, index, course.shares);
  for (int k = 0; k < kMost; ++k) {
    const std::vector<Law> laws = sweep_back(car, range, index, path);

    // The whole change of the law, or a part of it, until the index falls.
    Path best;
    best.sum = INFINITY;
    for (double step = 1; step >= kLeastStep && !(best.sum < path.sum); step /= 2)
      best = run(car, range, index, [&](std::size_t cell, const State& z, double, double) {
        const double wanted = (laws[cell] * z)(0, 0);
        return wanted - (1 - step) * ((laws[cell] * path.states[cell])(0, 0) - path.forces[cell]);
      });

    // No fall, or none worth another sweep: this is the best.
    if (!(best.sum < path.sum)) break;
    const bool enough = path.sum - best.sum < kLeastFall * path.sum;
    path = std::move(best);
    if (enough) break;
  }
  return course_of(car, std::move(path));
}

}  // namespace dashpot
