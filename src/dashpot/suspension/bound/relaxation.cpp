#include "dashpot/suspension/bound/relaxation.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "dashpot/numerics/median.h"
#include "dashpot/numerics/minimise.h"
#include "dashpot/suspension/bound/limited_cost.h"

namespace dashpot {
namespace {

/// The coefficients of a limit, for loops over them.
constexpr double ForceLimit::* kCoefficients[] = {
    &ForceLimit::ff, &ForceLimit::fv, &ForceLimit::vv, &ForceLimit::f,  &ForceLimit::v,
    &ForceLimit::fx, &ForceLimit::vx, &ForceLimit::x,  &ForceLimit::one};

/// Second moments of [q, q', 1] as those of [q, q', 1, F], where F follows a law of these.
CostForm with_force(const StateForm& moment, const SmallMatrix<1, 5>& law) {
  const SmallMatrix<1, 5> of_force = law * moment;
  CostForm joint;
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t j = 0; j < 5; ++j) {
      joint(i, j) = moment(i, j);
      joint(i, kForcePlace) += moment(i, j) * law(0, j);
    }
    joint(kForcePlace, i) = of_force(0, i);
    joint(kForcePlace, kForcePlace) += of_force(0, i) * law(0, i);
  }
  return joint;
}

/// The second moments of [q, q', 1] after the motion.
StateForm after_motion(const CostForm& joint, const SmallMatrix<5, 6>& motion) {
  // The motion's last row leaves the 1 as it is.
  SmallMatrix<5, 6> moved;
  for (std::size_t i = 0; i < kOnePlace; ++i)
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t j = 0; j < 6; ++j) moved(i, j) += motion(i, k) * joint(k, j);
  for (std::size_t j = 0; j < 6; ++j) moved(kOnePlace, j) = joint(kOnePlace, j);

  const SmallMatrix<6, 5> turned = transposed(motion);
  StateForm moment;
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t j = 0; j < kOnePlace; ++j) moment(i, j) += moved(i, k) * turned(k, j);
    moment(i, kOnePlace) = moved(i, kOnePlace);
  }
  return moment;
}

/// The minimum of L by its limits, with a barrier before the edge of those that have none: the sum
/// over cells of barrier * log(R), R being the curvature of L by a cell's force. It is the minimum
/// of the mean of L under forces that also tremble, less what a measure of order costs.
class Dual {
 public:
  Dual(const SampledPlant& car, const RideIndex& index, bool has_displacement)
      : step_(car.step()),
        has_displacement_(has_displacement),
        curvature_(car.cells()),
        law_(car.cells()) {
    for (std::size_t cell = 0; cell < car.cells(); ++cell) {
      cars_.push_back(car.over(cell));
      costs_.push_back(cost_form(cars_.back(), index));
    }
  }

  /// False where there is no minimum.
  bool value(const LimitCourse& course, double barrier, double& out) {
    StateForm value;
    double logarithms = 0;
    for (std::size_t cell = cars_.size(); cell-- > 0;) {
      // One step back: the value over [q, q', 1], least by the force.
      const AffineCar& now = cars_[cell];
      const CostForm form = step_ * limited_cost(costs_[cell], now, course.in(cell)) +
                            before_motion(value, now.motion);
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
    for (std::size_t cell = 0; cell < cars_.size(); ++cell) {
      const AffineCar& now = cars_[cell];
      CostForm joint = with_force(moment, law_[cell]);
      joint(kForcePlace, kForcePlace) += barrier / curvature_[cell];

      const SmallMatrix<1, 6> with_speed = now.speed * joint;
      const double h = step_;
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
      moment = after_motion(joint, now.motion);
    }
    return out;
  }

 private:
  double step_;
  std::vector<AffineCar> cars_;  ///< by cell
  std::vector<CostForm> costs_;  ///< the index's, by cell
  bool has_displacement_;        ///< the limits have it
  std::vector<double> curvature_;
  std::vector<SmallMatrix<1, 5>> law_;
};

/// Limits that hold a range in, by unknowns.
class LimitFamily {
 public:
  virtual ~LimitFamily() = default;
  virtual std::size_t unknowns() const = 0;
  /// `mean`: where given, what slopes() asks for beside the unknowns: how much less the constant
  /// becomes with each coefficient.
  virtual ForceLimit limit(const double* x, ForceLimit* mean) const = 0;
  /// The slopes by the unknowns, from those by the limit's coefficients.
  virtual void slopes(const double* x, const ForceLimit& mean, const ForceLimit& by_limit,
                      double* by_x) const = 0;
};

/// Sectors, by the logarithms of their multipliers.
class SectorFamily final : public LimitFamily {
 public:
  explicit SectorFamily(std::vector<ForceLimit> sectors) : sectors_(std::move(sectors)) {}
  std::size_t unknowns() const override { return sectors_.size(); }

  ForceLimit limit(const double* x, ForceLimit*) const override {
    ForceLimit sum;
    for (std::size_t k = 0; k < sectors_.size(); ++k)
      for (const auto one : kCoefficients) sum.*one += std::exp(x[k]) * sectors_[k].*one;
    return sum;
  }

  void slopes(const double* x, const ForceLimit&, const ForceLimit& by_limit,
              double* by_x) const override {
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
///
/// The unknowns are amounts of quadratics that vary over the corners without regard to each other:
/// F^2, F v, v^2 say nearly the same there, and a climb by their own coefficients hardly moves.
class FreeFamily final : public LimitFamily {
 public:
  FreeFamily(const ForceRange& range, double curvature)
      : curvature_(curvature), terms_(range.sides.empty() ? 5 : 8) {
    // Corners count by how usual their speed is.
    const double usual = kUsualSpeed * range.velocity.back();
    for (const auto [x, v, f] : corners(range)) {
      const double all[] = {f * f, f * v, v * v, f, v, f * x, v * x, x};
      for (std::size_t k = 0; k < terms_.size(); ++k) terms_[k].push_back(all[k]);
      weights_.push_back(std::exp(-0.5 * v * v / (usual * usual)));
    }

    values_.resize(weights_.size());

    // An amount of 1 is as large as the index's own share of a usual force.
    const double force = std::max(std::abs(range.force(usual, 1)), 1e-6);
    set_basis(curvature * force * force);
  }

  void set_smoothness(double smoothness) { smoothness_ = smoothness; }
  std::size_t unknowns() const override { return basis_.size() + 1; }

  ForceLimit limit(const double* x, ForceLimit* mean) const override {
    ForceLimit q = of(x);
    q.one = -least(q, mean);
    return q;
  }

  void slopes(const double* x, const ForceLimit& mean, const ForceLimit& by_limit,
              double* by_x) const override {
    const auto along = [&](const ForceLimit& direction) {
      double sum = 0;
      for (std::size_t k = 0; k < terms_.size(); ++k) {
        const auto one = kCoefficients[k];
        sum += direction.*one * (by_limit.*one - by_limit.one * mean.*one);
      }
      return sum;
    };
    const double root = std::hypot(x[0], 2 * kBend);
    by_x[0] = -curvature_ * bent(x[0]) / root * along(square_);
    for (std::size_t k = 0; k < basis_.size(); ++k) by_x[k + 1] = along(basis_[k]);
  }

  std::vector<double> unknowns_of(const ForceLimit& q) const {
    const double share = std::max(-q.ff / curvature_, 1e-12);
    std::vector<double> x{share - kBend * kBend / share};
    const std::vector<double> values = at_corners(q);
    for (const ForceLimit& one : basis_)
      x.push_back(covariance(values, at_corners(one)) / (size_ * size_));
    return x;
  }

 private:
  static constexpr double kUsualSpeed = 0.2;  // of the greatest
  static constexpr double kBend = 0.1;

  /// Above 0 for every x, and x where that is large: the root r of r - kBend^2 / r = x. Its slope
  /// is r / hypot(x, 2 kBend). Other than an exponential it lets small ones grow again.
  static double bent(double x) {
    const double root = std::hypot(x, 2 * kBend);
    return x > 0 ? 0.5 * (x + root) : 2 * kBend * kBend / (root - x);
  }

  /// One coefficient after the other, less what those before have of it; F^2, which has a sign, the
  /// last.
  void set_basis(double size) {
    size_ = size;
    for (std::size_t k = 1; k <= terms_.size(); ++k) {
      ForceLimit next;
      next.*kCoefficients[k % terms_.size()] = 1;
      const double all = variance(next);
      for (const ForceLimit& before : basis_)
        add(next, -covariance(at_corners(next), at_corners(before)) / (size * size), before);

      // What the others say already needs no unknown of its own.
      constexpr double kNothing = 1e-12;
      const double own = variance(next);
      if (k == terms_.size()) {
        square_ = next;
      } else if (own > kNothing * all) {
        basis_.emplace_back();
        add(basis_.back(), size / std::sqrt(own), next);
      }
    }
  }

  static void add(ForceLimit& sum, double factor, const ForceLimit& q) {
    for (const auto one : kCoefficients) sum.*one += factor * q.*one;
  }
  ForceLimit of(const double* x) const {
    ForceLimit q;
    add(q, -curvature_ * bent(x[0]), square_);
    for (std::size_t k = 0; k < basis_.size(); ++k) add(q, x[k + 1], basis_[k]);
    return q;
  }

  std::vector<double> at_corners(const ForceLimit& q) const {
    std::vector<double> values(weights_.size());
    set_values(q, values);
    return values;
  }
  void set_values(const ForceLimit& q, std::vector<double>& values) const {
    std::ranges::fill(values, 0.0);
    for (std::size_t k = 0; k < terms_.size(); ++k) {
      const double by = q.*kCoefficients[k];
      for (std::size_t i = 0; i < values.size(); ++i) values[i] += by * terms_[k][i];
    }
  }
  double variance(const ForceLimit& q) const {
    const std::vector<double> values = at_corners(q);
    return covariance(values, values);
  }
  double covariance(const std::vector<double>& a, const std::vector<double>& b) const {
    double all = 0, mean_a = 0, mean_b = 0, sum = 0;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      all += weights_[i];
      mean_a += weights_[i] * a[i];
      mean_b += weights_[i] * b[i];
    }
    for (std::size_t i = 0; i < weights_.size(); ++i)
      sum += weights_[i] * (a[i] - mean_a / all) * (b[i] - mean_b / all);
    return sum / all;
  }

  /// And the mean of [F^2, F v, v^2, F, v, F x, v x, x] by the weights of the corners in it.
  double least(const ForceLimit& q, ForceLimit* mean) const {
    // The sharp least, from which the weights count so that none overflows.
    set_values(q, values_);
    double least = values_.front();
    for (const double value : values_) least = std::min(least, value);

    // The weights of the corners; those of exp(-40) and less change nothing.
    const double counts = 40 * smoothness_;
    double sum = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const double above = values_[i] - least;
      if (above > counts) continue;
      const double weight = std::exp(-above / smoothness_);
      sum += weight;
      if (!mean) continue;
      for (std::size_t k = 0; k < terms_.size(); ++k)
        mean->*kCoefficients[k] += weight * terms_[k][i];
    }

    if (mean)
      for (const auto one : kCoefficients) mean->*one /= sum;
    return least - smoothness_ * std::log(sum);
  }

  double curvature_, size_ = 1, smoothness_ = 1;
  std::vector<std::vector<double>> terms_;  ///< by coefficient, at each corner
  std::vector<double> weights_;             ///< of the corners
  ForceLimit square_;                       ///< F^2 and what makes it vary by itself
  std::vector<ForceLimit> basis_;           ///< the other ones
  mutable std::vector<double> values_;      ///< for least()
};

/// With `means`, of the same length as the limits, for the slopes.
LimitCourse course_of(const LimitFamily& family, const std::vector<double>& x, std::size_t block,
                      std::vector<ForceLimit>* means = nullptr) {
  LimitCourse course{.block = block, .limits = {}};
  for (std::size_t k = 0; k < x.size(); k += family.unknowns()) {
    ForceLimit* const mean = means ? &means->emplace_back() : nullptr;
    course.limits.push_back(family.limit(x.data() + k, mean));
  }
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
      std::vector<ForceLimit> means;
      const LimitCourse course = course_of(family, x, block, gradient.empty() ? nullptr : &means);
      if (!dual.value(course, barrier, value)) return false;
      value /= -scale;
      if (gradient.empty()) return true;
      const std::vector<ForceLimit> slopes = dual.slopes(course, barrier);
      for (std::size_t k = 0; k < slopes.size(); ++k)
        family.slopes(x.data() + k * n, means[k], slopes[k], gradient.data() + k * n);
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

    // Tight: such a climb stops for a while where limits change their corners.
    const MinimiseOptions how{.max_iterations = iterations,
                              .function_tolerance = 1e-10,
                              .memory = 50,
                              .on_iteration = {}};
    at(minimise(fall, none, how).x);
  }
};

}  // namespace

Relaxation relax(const SampledPlant& car, const ForceRange& range, const RideIndex& index,
                 const RelaxationOptions& options) {
  // Units: the weight that the index itself gives a force.
  const double by_force = car.at(0, 0).acceleration(0, kForcePlace);
  const double curvature = index.comfort * by_force * by_force + index.holding;
  Dual dual(car, index, !range.sides.empty());

  // Sectors that stay; what comes then, over shorter and shorter blocks, goes on towards the edge.
  // Where the index does not weigh the force, steep sectors leave no minimum: these go first.
  std::vector<ForceLimit> known = sector_limits(range);
  Climb climb{car, dual, options.size, options.iterations};
  while (!known.empty() && !climb.start(SectorFamily(known), curvature)) known.erase(known.begin());
  if (known.empty()) return {};
  const SectorFamily sectors(std::move(known));
  for (const double height : {1.0, 0.1, 0.01}) climb.up(sectors, height);
  Relaxation found{.path = {}, .constant = course_of(sectors, climb.x, climb.block)};

  // Over shorter blocks, where that is asked for or, the range having no end, sectors are all.
  const bool by_short = !range.ends || options.start == RelaxationStart::Short;
  if (by_short)
    for (const std::size_t block : {16, 4}) {
      climb.set_block(sectors, block * options.block);
      for (const double height : {0.3, 0.1}) climb.up(sectors, height);
    }
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
  std::vector<double> start;
  for (const ForceLimit& limit : course_of(sectors, climb.x, climb.block).limits)
    for (const double x : free.unknowns_of(limit)) start.push_back(x);
  climb.x = std::move(start);
  const auto up = [&](std::size_t block, std::initializer_list<double> heights) {
    climb.set_block(free, block * options.block);
    for (const double height : heights) {
      free.set_smoothness(height * options.size);
      climb.up(free, height);
      found.path.push_back(course_of(free, climb.x, climb.block));
    }
  };
  if (!by_short) {
    up(16, {0.3, 0.1});
    up(8, {0.1});
  }
  up(4, {0.1});
  up(2, {0.1, 0.03});
  up(1, {0.1, 0.03, 0.01, 0.003});
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
    const double greatest = factor * median(std::move(sizes));
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
