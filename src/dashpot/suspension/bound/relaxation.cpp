#include "dashpot/suspension/bound/relaxation.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "dashpot/numerics/minimise.h"
#include "dashpot/suspension/bound/limited_cost.h"

namespace dashpot {
namespace {

/// The coefficients of a limit, for loops over them.
constexpr double ForceLimit::* kCoefficients[] = {
    &ForceLimit::ff, &ForceLimit::fv, &ForceLimit::vv, &ForceLimit::f,  &ForceLimit::v,
    &ForceLimit::fx, &ForceLimit::vx, &ForceLimit::x,  &ForceLimit::one};

/// The minimum of L by its limits, with a barrier before the edge of those that have none: the sum
/// over cells of barrier * log(R), R being the curvature of L by a cell's force. It is the minimum
/// of the mean of L under forces that also tremble, less what a measure of order costs.
class Dual {
 public:
  Dual(const SampledPlant& car, const RideIndex& index, bool has_displacement)
      : car_(car),
        index_(index),
        has_displacement_(has_displacement),
        curvature_(car.cells()),
        law_(car.cells()) {}

  /// False where there is no minimum.
  bool value(const LimitCourse& course, double barrier, double& out) {
    StateForm value;
    double logarithms = 0;
    for (std::size_t cell = car_.cells(); cell-- > 0;) {
      // One step back: the value over [q, q', 1], least by the force.
      const AffineCar now = car_.over(cell);
      const CostForm form = car_.step() * limited_cost(now, course.in(cell), index_) +
                            transposed(now.motion) * (value * now.motion);
      curvature_[cell] = form(kForcePlace, kForcePlace);
      if (!(curvature_[cell] > 0)) return false;
      const LeastOverForce least = least_over_force(form);
      value = least.value;
      law_[cell] = least.law;
      logarithms += std::log(curvature_[cell]);
    }
    out = value(kOnePlace, kOnePlace) + barrier * logarithms;
    return std::isfinite(out);
  }

  /// Its slopes by the coefficients of each block's limit, at the course of the last value(): less
  /// the means of [F^2, F v, v^2, F, v, F x, v x, x, 1] under the law and the trembling.
  std::vector<ForceLimit> slopes(const LimitCourse& course, double barrier) const {
    std::vector<ForceLimit> out(course.limits.size());
    StateForm moment;
    moment(kOnePlace, kOnePlace) = 1;
    for (std::size_t cell = 0; cell < car_.cells(); ++cell) {
      const AffineCar now = car_.over(cell);
      SmallMatrix<6, 5> lift;
      for (std::size_t i = 0; i < 5; ++i) {
        lift(i, i) = 1;
        lift(kForcePlace, i) = law_[cell](0, i);
      }
      CostForm joint = lift * moment * transposed(lift);
      joint(kForcePlace, kForcePlace) += barrier / curvature_[cell];

      const SmallMatrix<1, 6> with_speed = now.speed * joint;
      const double h = car_.step();
      ForceLimit& slope = out[cell / course.block];
      slope.ff -= h * joint(kForcePlace, kForcePlace);
      slope.fv -= h * with_speed(0, kForcePlace);
      slope.vv -= h * (with_speed * transposed(now.speed))(0, 0);
      slope.f -= h * joint(kForcePlace, kOnePlace);
      slope.v -= h * with_speed(0, kOnePlace);
      if (has_displacement_) {
        const SmallMatrix<1, 6> with_displacement = now.displacement * joint;
        slope.fx -= h * with_displacement(0, kForcePlace);
        slope.vx -= h * (with_displacement * transposed(now.speed))(0, 0);
        slope.x -= h * with_displacement(0, kOnePlace);
      }
      slope.one -= h;
      moment = now.motion * joint * transposed(now.motion);
    }
    return out;
  }

 private:
  const SampledPlant& car_;
  const RideIndex& index_;
  bool has_displacement_;  ///< the limits have it
  std::vector<double> curvature_;
  std::vector<SmallMatrix<1, 5>> law_;
};

/// Limits that hold a range in, by unknowns.
class LimitFamily {
 public:
  virtual ~LimitFamily() = default;
  virtual std::size_t unknowns() const = 0;
  virtual ForceLimit limit(const double* x) const = 0;
  /// The slopes by the unknowns, from those by the limit's coefficients.
  virtual void slopes(const double* x, const ForceLimit& by_limit, double* by_x) const = 0;
};

/// Sectors, by the logarithms of their multipliers.
class SectorFamily final : public LimitFamily {
 public:
  explicit SectorFamily(std::vector<ForceLimit> sectors) : sectors_(std::move(sectors)) {}
  std::size_t unknowns() const override { return sectors_.size(); }

  ForceLimit limit(const double* x) const override {
    ForceLimit sum;
    for (std::size_t k = 0; k < sectors_.size(); ++k)
      for (const auto one : kCoefficients) sum.*one += std::exp(x[k]) * sectors_[k].*one;
    return sum;
  }

  void slopes(const double* x, const ForceLimit& by_limit, double* by_x) const override {
    for (std::size_t k = 0; k < sectors_.size(); ++k) {
      double sum = 0;
      for (const auto one : kCoefficients) sum += by_limit.*one * sectors_[k].*one;
      by_x[k] = std::exp(x[k]) * sum;
    }
  }

 private:
  std::vector<ForceLimit> sectors_;
};

/// Every limit of a range that ends: any coefficients, of which the constant follows, being less
/// the least over the range's corners. That least is made smooth: -t log(sum of exp(-q / t)).
class FreeFamily final : public LimitFamily {
 public:
  FreeFamily(const ForceRange& range, double curvature)
      : corners_(corners(range)), values_(corners_.size()) {
    // Units in which unknowns are about 1.
    const double speed = 0.2 * range.velocity.back();
    const double force = std::max(std::abs(range.force(speed, 1)), 1e-6);
    const double damping = force / speed;
    unit_ = {curvature, curvature * damping, curvature * damping * damping, curvature * force,
             curvature * damping * force};
    if (range.sides.empty()) return;
    const double spring = force / (0.2 * range.travel);
    for (const double unit : {spring, spring * damping, spring * force})
      unit_.push_back(curvature * unit);
  }

  void set_smoothness(double smoothness) { smoothness_ = smoothness; }
  std::size_t unknowns() const override { return unit_.size(); }

  ForceLimit limit(const double* x) const override {
    ForceLimit q = of(x);
    q.one = -least(q, nullptr);
    return q;
  }

  void slopes(const double* x, const ForceLimit& by_limit, double* by_x) const override {
    const ForceLimit q = of(x);
    ForceLimit mean;
    least(q, &mean);
    for (std::size_t k = 0; k < unit_.size(); ++k) {
      const auto one = kCoefficients[k];
      by_x[k] = (k == 0 ? q.ff : unit_[k]) * (by_limit.*one - by_limit.one * mean.*one);
    }
  }

  std::vector<double> unknowns_of(const ForceLimit& q) const {
    std::vector<double> x{std::log(std::max(-q.ff / unit_[0], 1e-12))};
    for (std::size_t k = 1; k < unit_.size(); ++k) x.push_back(q.*kCoefficients[k] / unit_[k]);
    return x;
  }

 private:
  ForceLimit of(const double* x) const {
    ForceLimit q{.ff = -unit_[0] * std::exp(x[0])};
    for (std::size_t k = 1; k < unit_.size(); ++k) q.*kCoefficients[k] = unit_[k] * x[k];
    return q;
  }

  /// And the mean of [F^2, F v, v^2, F, v, F x, v x, x] by the weights of the corners in it.
  double least(const ForceLimit& q, ForceLimit* mean) const {
    // The sharp least, from which the weights count so that none overflows.
    double least = INFINITY;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      values_[k] = q.at(corners_[k].displacement, corners_[k].velocity, corners_[k].force);
      least = std::min(least, values_[k]);
    }

    // The weights of the corners; those of exp(-40) and less change nothing.
    constexpr double kNothing = 40;
    double sum = 0;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const double above = (values_[k] - least) / smoothness_;
      if (above > kNothing) continue;
      const double weight = std::exp(-above);
      sum += weight;
      if (!mean) continue;

      const auto [x, v, f] = corners_[k];
      mean->ff += weight * f * f;
      mean->fv += weight * f * v;
      mean->vv += weight * v * v;
      mean->f += weight * f;
      mean->v += weight * v;
      mean->fx += weight * f * x;
      mean->vx += weight * v * x;
      mean->x += weight * x;
    }

    if (mean)
      for (const auto one : kCoefficients) mean->*one /= sum;
    return least - smoothness_ * std::log(sum);
  }

  std::vector<RangeCorner> corners_;
  std::vector<double> unit_;  ///< of the coefficients, in their order
  double smoothness_ = 1;
  mutable std::vector<double> values_;
};

LimitCourse course_of(const LimitFamily& family, const std::vector<double>& x, std::size_t block) {
  LimitCourse course{.block = block, .limits = {}};
  for (std::size_t k = 0; k < x.size(); k += family.unknowns())
    course.limits.push_back(family.limit(x.data() + k));
  return course;
}

/// Unknowns of blocks, and the climb from them.
struct Climb {
  const SampledPlant& car;
  Dual& dual;
  double size;
  int iterations;

  std::size_t block = 1;
  std::vector<double> x = {};

  /// The same small multiplier for every sector, as small as a minimum asks for.
  bool start(const SectorFamily& sectors, double multiplier) {
    block = car.cells();
    constexpr int kTries = 16;
    for (int k = 0; k < kTries; ++k, multiplier /= 4) {
      x.assign(sectors.unknowns(), std::log(multiplier));
      double value;
      if (dual.value(course_of(sectors, x, block), 0, value)) return true;
    }
    return false;
  }

  void set_block(const LimitFamily& family, std::size_t length) {
    const std::size_t n = family.unknowns(), blocks = (car.cells() + length - 1) / length;
    std::vector<double> finer;
    for (std::size_t k = 0; k < blocks; ++k) {
      const double* from = x.data() + std::min(k * length / block, x.size() / n - 1) * n;
      finer.insert(finer.end(), from, from + n);
    }
    x = std::move(finer);
    block = length;
  }

  /// height: of the barrier, as a share of the index.
  void up(const LimitFamily& family, double height) {
    const std::size_t n = family.unknowns();
    const double barrier = height * car.step() * size,
                 scale = size * car.step() * static_cast<double>(car.cells());
    const std::vector<double> start = x;
    std::vector<double> unit(x.size(), 1);
    const auto at = [&](std::span<const double> steps) {
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = start[k] + unit[k] * steps[k];
    };
    const auto fall = [&](std::span<const double> steps, double& value,
                          std::span<double> gradient) {
      at(steps);
      const LimitCourse course = course_of(family, x, block);
      if (!dual.value(course, barrier, value)) return false;
      value /= -scale;
      if (gradient.empty()) return true;
      const std::vector<ForceLimit> slopes = dual.slopes(course, barrier);
      for (std::size_t k = 0; k < slopes.size(); ++k)
        family.slopes(x.data() + k * n, slopes[k], gradient.data() + k * n);
      for (std::size_t k = 0; k < gradient.size(); ++k) gradient[k] *= -unit[k] / scale;
      return true;
    };

    // Unknowns with large slopes take smaller steps.
    double value;
    std::vector<double> none(x.size()), gradient(x.size());
    if (!fall(none, value, gradient)) return;
    double square = 0;
    for (const double slope : gradient) square += slope * slope;
    const double mean = std::sqrt(square / static_cast<double>(gradient.size()));
    for (std::size_t k = 0; k < unit.size(); ++k)
      unit[k] = 1 / std::sqrt(std::abs(gradient[k]) / mean + 0.01);

    at(minimise(fall, none,
                {.max_iterations = iterations, .function_tolerance = 1e-7, .on_iteration = {}})
           .x);
  }
};

}  // namespace

Relaxation relax(const SampledPlant& car, const ForceRange& range, const RideIndex& index,
                 const RelaxationOptions& options) {
  // Units: the weight that the index itself gives a force.
  const double by_force = car.at(0, 0).acceleration(0, kForcePlace);
  const double curvature = index.comfort * by_force * by_force + index.holding;
  Dual dual(car, index, !range.sides.empty());

  // Sectors that stay, then over shorter and shorter blocks, towards the edge.
  const SectorFamily sectors(sector_limits(range));
  if (sectors.unknowns() == 0) return {};
  Climb climb{car, dual, options.size, options.iterations};
  if (!climb.start(sectors, curvature)) return {};
  for (const double height : {1.0, 0.1, 0.01}) climb.up(sectors, height);
  Relaxation found{.path = {}, .constant = course_of(sectors, climb.x, climb.block)};
  for (const std::size_t block : {16, 4}) {
    climb.set_block(sectors, block * options.block);
    for (const double height : {0.3, 0.1}) climb.up(sectors, height);
  }

  // Where the range has no end, sectors are all there is.
  if (!range.ends) {
    climb.set_block(sectors, options.block);
    for (const double height : {0.1, 0.03, 0.01, 0.003}) {
      climb.up(sectors, height);
      found.path.push_back(course_of(sectors, climb.x, climb.block));
    }
    return found;
  }

  // Any limits, from those sectors on.
  FreeFamily free(range, curvature);
  const LimitCourse start = course_of(sectors, climb.x, climb.block);
  climb.x.clear();
  for (const ForceLimit& limit : start.limits) {
    const std::vector<double> x = free.unknowns_of(limit);
    climb.x.insert(climb.x.end(), x.begin(), x.end());
  }
  const auto up = [&](double height) {
    constexpr double kSmoothness = 1;
    free.set_smoothness(kSmoothness * height * options.size);
    climb.up(free, height);
    found.path.push_back(course_of(free, climb.x, climb.block));
  };
  for (const double height : {0.3, 0.1}) up(height);
  for (const std::size_t block : {2, 1}) {
    climb.set_block(free, block * options.block);
    for (const double height : {0.1, 0.03}) up(height);
  }
  for (const double height : {0.01, 0.003}) up(height);
  return found;
}

LimitCourse on_cells(const LimitCourse& course, std::size_t cells, double ratio) {
  const auto block = static_cast<std::size_t>(
      std::max(1.0, std::round(static_cast<double>(course.block) * ratio)));
  LimitCourse to{.block = block, .limits = {}};
  for (std::size_t cell = 0; cell < cells; cell += block) {
    const auto there = static_cast<std::size_t>((static_cast<double>(cell) + 0.5) / ratio);
    to.limits.push_back(course.limits[std::min(there / course.block, course.limits.size() - 1)]);
  }
  return to;
}

void tame(LimitCourse& course, double factor) {
  std::vector<double> shares(course.limits.size(), 1);
  for (const auto measure : {&ForceLimit::ff, &ForceLimit::one}) {
    std::vector<double> sizes;
    for (const ForceLimit& limit : course.limits) sizes.push_back(std::abs(limit.*measure));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double greatest = factor * *middle;
    for (std::size_t k = 0; k < shares.size(); ++k)
      if (const double size = std::abs(course.limits[k].*measure); size > greatest)
        shares[k] = std::min(shares[k], greatest / size);
  }
  for (std::size_t k = 0; k < shares.size(); ++k)
    for (const auto one : kCoefficients) course.limits[k].*one *= shares[k];
}

LimitCourse mixed(const LimitCourse& a, const LimitCourse& b, double share_of_b, double size_of_b) {
  LimitCourse out = a;
  for (ForceLimit& limit : out.limits)
    for (const auto one : kCoefficients)
      limit.*one = (1 - share_of_b) * limit.*one + share_of_b * size_of_b * b.limits.front().*one;
  return out;
}

}  // namespace dashpot
