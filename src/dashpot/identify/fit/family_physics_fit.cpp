#include "dashpot/identify/fit/family_physics_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/kinds/family/physics_information.h"
#include "dashpot/error.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/least_squares.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

// What a build and what a record's model error are taken to be, as shares of the force, until
// left-out dampers have told: their ratio is the ridge of builds.
constexpr double kBuildSpread = 0.08, kRecordError = 0.05;
// What geometry's ridges are chosen from.
constexpr std::array kAllRidges{1e-4, 1e-3, 1e-2, 1e-1}, kYieldRidges{1e-3, 1e-2, 1e-1, 1.0};
constexpr std::array kSpringRidges{1e-4, 1e-3, 1e-2, 1e-1, 1.0};
constexpr double kOffsetRidge = 1e-5;
// Of the first solution, and of the last one, which begins where that has ended.
constexpr int kPhysicsIterations = 30, kLastIterations = 10;
constexpr double kDifferenceStep = 1e-5;  // of the differences

/// Normal equations of a part of the records.
struct Normal {
  std::vector<double> matrix, right;  // J'J, J'r
  double squares = 0;                 // r'r
};

void add(Normal& to, const Normal& part, double sign) {
  for (std::size_t k = 0; k < to.matrix.size(); ++k) to.matrix[k] += sign * part.matrix[k];
  for (std::size_t k = 0; k < to.right.size(); ++k) to.right[k] += sign * part.right[k];
}

double rms_of(const FamilyRecord& record) {
  double square = 0;
  for (std::size_t k = record.first; k < record.force.size(); ++k)
    square += record.force[k] * record.force[k];
  return std::sqrt(square / static_cast<double>(record.force.size() - record.first));
}

FamilyPhysics::Reference reference_of(const std::vector<FamilyRecord>& records) {
  FamilyPhysics::Reference r;
  const auto n = static_cast<double>(records.size());

  // The middle of each number of the dampers, by its logarithm.
  const auto middle = [&](const auto& number) {
    double sum = 0;
    for (const FamilyRecord& record : records) sum += std::log(number(record)) / n;
    return std::exp(sum);
  };
  r.piston_area = middle([](const FamilyRecord& k) { return k.member.piston_area; });
  r.gap_area = middle([](const FamilyRecord& k) { return k.member.gap_area; });
  r.gap = middle([](const FamilyRecord& k) { return k.member.gap; });
  r.pole_length = middle([](const FamilyRecord& k) { return k.member.pole_length; });
  r.viscosity = middle([](const FamilyRecord& k) { return k.member.viscosity; });

  // The field: the middle of the yield stresses that there are, and the median current.
  std::vector<double> yields, currents;
  for (const FamilyRecord& record : records) {
    const double i = std::abs(record.inputs[record.first].current);
    if (const double stress = record.member.yield.at(i); stress > 0)
      yields.push_back(std::log(stress));
    if (i > 0) currents.push_back(i);
  }
  double sum = 0;
  for (const double stress : yields) sum += stress / static_cast<double>(yields.size());
  r.yield_stress = yields.empty() ? 1 : std::exp(sum);
  std::ranges::sort(currents);
  r.current = currents.empty() ? 1 : currents[currents.size() / 2];

  // The motion and the force, each as the amplitude of a sine.
  double speed = 0, stroke = 0, samples = 0;
  r.force = 0;
  for (const FamilyRecord& record : records) {
    double way = 0, mean = 0;
    const auto count = static_cast<double>(record.force.size() - record.first);
    for (std::size_t k = record.first; k < record.force.size(); ++k) {
      speed += record.inputs[k].velocity * record.inputs[k].velocity;
      const double dt = k > 0 ? record.time[k] - record.time[k - 1] : 0;
      way += dt * record.inputs[k].velocity;
      mean += way / count;
      stroke += way * way;
    }
    stroke -= count * mean * mean;
    samples += count;
    r.force += std::numbers::sqrt2 * rms_of(record) / n;
  }
  r.speed = std::sqrt(2 * speed / samples);
  r.stroke = std::sqrt(2 * std::max(0., stroke) / samples);
  if (!(r.speed > 0 && r.stroke > 0 && r.force > 0))
    throw Error("family_physics", "nothing moves in these records");
  return r;
}

/// The fit's unknowns are the numbers, the offset over the reference force and the logarithm of
/// each damper's build; its residuals are those of the samples, each record with the same weight,
/// and the ridges.
class PhysicsProblem {
 public:
  PhysicsProblem(const std::vector<FamilyRecord>& records, int threads, const Monitor& monitor)
      : records_(records), groups_(groups_of(records)), threads_(threads), monitor_(monitor) {
    physics_.reference = reference_of(records);
    physics_.numbers = FamilyPhysics::priors();
    for (const FamilyRecord& record : records) {
      first_.push_back(samples_);
      const std::size_t count = record.force.size() - record.first;
      samples_ += count;
      const double size = std::max(rms_of(record), 1e-3 * physics_.reference.force);
      weight_.push_back(1 / (size * std::sqrt(static_cast<double>(count * records.size()))));
    }
    first_.push_back(samples_);
  }

  std::size_t unknowns() const { return kPhysicsNumbers + 1 + groups_.dampers; }
  const FamilyGroups& groups() const { return groups_; }
  static constexpr std::size_t kOffset = kPhysicsNumbers;

  std::vector<double> start() const {
    std::vector<double> x(unknowns(), 0.);
    std::ranges::copy(physics_.numbers, x.begin());
    return x;
  }

  double belief(std::size_t k, const GeometryRidges& ridges) const {
    if (k == kOffset) return kOffsetRidge;
    if (k > kOffset)
      return kRecordError * kRecordError / (kBuildSpread * kBuildSpread) /
             static_cast<double>(records_.size());
    const PhysicsNumber& number = FamilyPhysics::table()[k];
    if (!number.is_geometry) return number.belief;
    if (k >= kGapOfSpring) return ridges.spring;
    return k >= kGapOfYield ? ridges.yield : ridges.all;
  }
  double prior(std::size_t k) const { return k < kPhysicsNumbers ? physics_.numbers[k] : 0; }

  FamilyPhysics physics_of(std::span<const double> x) const {
    FamilyPhysics physics = physics_;
    std::copy_n(x.begin(), kPhysicsNumbers, physics.numbers.begin());
    return physics;
  }
  double offset_of(std::span<const double> x) const {
    return physics_.reference.force * x[kOffset];
  }

  LeastSquaresReport solve_with(const GeometryRidges& ridges, std::vector<double> x,
                                int iterations) const {
    // The physical numbers have ranges; what corrects them has none but its ridges.
    LeastSquaresProblem problem;
    problem.residuals = samples_ + unknowns();
    for (std::size_t k = 0; k < unknowns(); ++k) {
      const bool is_number = k < kPhysicsNumbers;
      problem.lower.push_back(is_number ? FamilyPhysics::table()[k].low : -INFINITY);
      problem.upper.push_back(is_number ? FamilyPhysics::table()[k].high : INFINITY);
    }

    problem.residual = [&](std::span<const double> at, std::span<double> r) {
      residuals(at, ridges, r);
      return true;
    };
    problem.jacobian = [&](std::span<const double> at, std::span<double> r,
                           std::span<double* const> columns) {
      jacobian(at, ridges, r, columns);
      return true;
    };

    LeastSquaresOptions options;
    options.max_iterations = iterations;
    options.function_tolerance = 1e-4;
    options.threads = 1;
    options.on_iteration = [&](int, double, std::span<const double>) { monitor_.check(); };
    return solve(problem, std::move(x), options);
  }

  /// The normal equations of the samples of each damper, without ridges.
  std::vector<Normal> normal_of_dampers(std::span<const double> x) const {
    const std::size_t n = unknowns();
    std::vector<std::vector<double>> columns(n, std::vector<double>(samples_ + n));
    std::vector<double*> pointers;
    for (auto& column : columns) pointers.push_back(column.data());
    std::vector<double> r(samples_ + n);
    jacobian(x, {}, r, pointers);

    std::vector<Normal> parts(groups_.dampers,
                              {std::vector<double>(n * n), std::vector<double>(n)});
    for (std::size_t k = 0; k < records_.size(); ++k) {
      Normal& part = parts[groups_.damper[k]];
      for (std::size_t s = first_[k]; s < first_[k + 1]; ++s) part.squares += r[s] * r[s];
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t s = first_[k]; s < first_[k + 1]; ++s) {
          part.right[i] += columns[i][s] * r[s];
          for (std::size_t j = 0; j < n; ++j)
            part.matrix[i * n + j] += columns[i][s] * columns[j][s];
        }
    }
    return parts;
  }

 private:
  /// The forces of all records, scored samples only, without offset.
  void forces(std::span<const double> x, std::span<double> out) const {
    const FamilyPhysics physics = physics_of(x);
    parallel_for(records_.size(), threads_, [&](std::size_t k) {
      const double build = std::exp(x[kOffset + 1 + groups_.damper[k]]);
      const std::vector<double> force =
          run_family_physics(physics, records_[k].member, records_[k].inputs, records_[k].time);
      for (std::size_t s = 0; s < first_[k + 1] - first_[k]; ++s)
        out[first_[k] + s] = build * force[records_[k].first + s];
    });
  }

  void residuals_of(std::span<const double> x, const GeometryRidges& ridges,
                    std::span<const double> force, std::span<double> r) const {
    const double offset = offset_of(x);
    for (std::size_t k = 0; k < records_.size(); ++k)
      for (std::size_t s = first_[k]; s < first_[k + 1]; ++s)
        r[s] =
            weight_[k] * (force[s] + offset - records_[k].force[records_[k].first + s - first_[k]]);
    for (std::size_t k = 0; k < unknowns(); ++k)
      r[samples_ + k] = std::sqrt(belief(k, ridges)) * (x[k] - prior(k));
  }
  void residuals(std::span<const double> x, const GeometryRidges& ridges,
                 std::span<double> r) const {
    std::vector<double> force(samples_);
    forces(x, force);
    residuals_of(x, ridges, force, r);
  }

  void jacobian(std::span<const double> x, const GeometryRidges& ridges, std::span<double> r,
                std::span<double* const> columns) const {
    std::vector<double> force(samples_), moved(samples_), at(x.begin(), x.end());
    forces(x, force);
    residuals_of(x, ridges, force, r);
    for (std::size_t i = 0; i < unknowns(); ++i) {
      if (!columns[i]) continue;
      std::fill_n(columns[i], samples_ + unknowns(), 0.);
      columns[i][samples_ + i] = std::sqrt(belief(i, ridges));

      // A number moves the forces of all, which is simulated; the offset and a build are known.
      if (i < kPhysicsNumbers) {
        const double step = x[i] + kDifferenceStep > FamilyPhysics::table()[i].high
                                ? -kDifferenceStep
                                : kDifferenceStep;
        at[i] = x[i] + step;
        forces(at, moved);
        at[i] = x[i];
        for (std::size_t k = 0; k < records_.size(); ++k)
          for (std::size_t s = first_[k]; s < first_[k + 1]; ++s)
            columns[i][s] = weight_[k] * (moved[s] - force[s]) / step;
        continue;
      }
      for (std::size_t k = 0; k < records_.size(); ++k)
        for (std::size_t s = first_[k]; s < first_[k + 1]; ++s) {
          if (i == kOffset) columns[i][s] = weight_[k] * physics_.reference.force;
          if (i == kOffset + 1 + groups_.damper[k]) columns[i][s] = weight_[k] * force[s];
        }
    }
  }

  const std::vector<FamilyRecord>& records_;
  FamilyGroups groups_;
  int threads_;
  const Monitor& monitor_;
  FamilyPhysics physics_;
  std::size_t samples_ = 0;
  std::vector<std::size_t> first_;
  std::vector<double> weight_;
};

/// Leaves each design out of a fit that is linear about the one found: what it costs, and where the
/// numbers move.
class LeftOutDesigns {
 public:
  LeftOutDesigns(const PhysicsProblem& problem, std::vector<double> x)
      : problem_(problem), x_(std::move(x)), dampers_(problem.normal_of_dampers(x_)) {
    const std::size_t n = problem.unknowns();
    const Normal none{std::vector<double>(n * n), std::vector<double>(n)};
    designs_.assign(problem.groups().designs, none);
    all_ = none;
    design_of_.resize(dampers_.size());
    for (std::size_t k = 0; k < problem.groups().damper.size(); ++k)
      design_of_[problem.groups().damper[k]] = problem.groups().design[k];
    for (std::size_t d = 0; d < dampers_.size(); ++d) {
      add(designs_[design_of_[d]], dampers_[d], 1);
      add(all_, dampers_[d], 1);
    }
  }

  std::size_t designs() const { return designs_.size(); }
  const FamilyGroups& groups() const { return problem_.groups(); }

  /// The step of all unknowns where this design is left out; empty where it is not determined.
  std::vector<double> step_without(std::size_t design, const GeometryRidges& ridges) const {
    const std::size_t n = problem_.unknowns();
    Normal rest = all_;
    add(rest, designs_[design], -1);
    std::vector<double> step(n);
    for (std::size_t k = 0; k < n; ++k) {
      const double belief = problem_.belief(k, ridges);
      rest.matrix[k * n + k] += belief;
      rest.right[k] = -rest.right[k] - belief * (x_[k] - problem_.prior(k));
    }
    if (!solve_positive_definite(rest.matrix, rest.right, step)) return {};
    return step;
  }

  /// What the weighted squares of all designs change by when each is predicted by the others.
  double cost(const GeometryRidges& ridges) const {
    double sum = 0;
    for (std::size_t g = 0; g < designs_.size(); ++g) {
      const std::vector<double> step = step_without(g, ridges);
      if (step.empty()) return INFINITY;
      const std::vector<double> moved = product(designs_[g].matrix, step, step.size());
      for (std::size_t k = 0; k < step.size(); ++k)
        sum += step[k] * (2 * designs_[g].right[k] + moved[k]);
    }
    return sum;
  }

  /// What all dampers tell of the numbers and the offset, each with its deviations eliminated, and
  /// the ridges: see FamilyPhysics::information.
  std::vector<double> information(const GeometryRidges& ridges,
                                  const FamilyPhysics& physics) const {
    const std::size_t n = problem_.unknowns();
    const auto records = static_cast<double>(problem_.groups().damper.size());
    std::vector<double> all(kPhysicsUnknowns * kPhysicsUnknowns);
    for (std::size_t d = 0; d < dampers_.size(); ++d) {
      // The damper's normal equations in the unknowns of all and its deviations. A record's squares
      // are shares of one over the number of records.
      std::vector<double> select(n * kTestRows);
      const std::vector<double> deviations = deviation_columns(d);
      for (std::size_t u = 0; u < n; ++u) {
        if (u < kPhysicsUnknowns) select[u * kTestRows + u] = 1;
        for (std::size_t k = 0; k < kCount; ++k)
          select[u * kTestRows + kPhysicsUnknowns + k] = deviations[u * kCount + k];
      }
      const std::vector<double> across = product(dampers_[d].matrix, select, n);
      std::vector<double> tests(kTestRows * kTestRows);
      for (std::size_t u = 0; u < n; ++u)
        for (std::size_t i = 0; i < kTestRows; ++i)
          for (std::size_t j = 0; j < kTestRows; ++j)
            tests[i * kTestRows + j] +=
                records * select[u * kTestRows + i] * across[u * kTestRows + j];
      const std::vector<double> told = damper_information(physics, tests);
      for (std::size_t k = 0; k < all.size(); ++k) all[k] += told[k];
    }
    for (std::size_t k = 0; k < kPhysicsUnknowns; ++k)
      all[k * kPhysicsUnknowns + k] +=
          records * problem_.belief(k, ridges) / (physics.record_error * physics.record_error);
    return all;
  }

  /// Deviations that bring each damper, predicted without its design, nearest to its records, in
  /// the order of FamilyPhysics::Deviation; and what they leave of its weighted squares.
  struct Deviated {
    std::vector<FamilyPhysics::Deviation> deviations;
    double squares_left = 0;  // of all dampers
  };
  Deviated deviations(const GeometryRidges& ridges) const {
    constexpr double kBelief = 1e-5;  // where a damper's records do not tell one
    const std::size_t n = problem_.unknowns();
    Deviated found;
    found.deviations.resize(dampers_.size());
    for (std::size_t d = 0; d < dampers_.size(); ++d) {
      const std::vector<double> step = step_without(design_of_[d], ridges);
      if (step.empty()) return {};
      const std::vector<double> moved = product(dampers_[d].matrix, step, n);

      const std::vector<double> select = deviation_columns(d);
      const std::vector<double> across = product(dampers_[d].matrix, select, n);
      std::vector<double> square(kCount * kCount), right(kCount);
      for (std::size_t i = 0; i < kCount; ++i)
        for (std::size_t u = 0; u < n; ++u) {
          right[i] -= select[u * kCount + i] * (dampers_[d].right[u] + moved[u]);
          for (std::size_t j = 0; j < kCount; ++j)
            square[i * kCount + j] += select[u * kCount + i] * across[u * kCount + j];
        }
      for (std::size_t i = 0; i < kCount; ++i) square[i * kCount + i] += kBelief;
      FamilyPhysics::Deviation& own = found.deviations[d];
      if (!solve_positive_definite(square, right, own)) return {};

      // At the deviations found, the squares fall by half of what their linear part tells.
      found.squares_left += dampers_[d].squares;
      for (std::size_t u = 0; u < n; ++u)
        found.squares_left += step[u] * (2 * dampers_[d].right[u] + moved[u]);
      for (std::size_t i = 0; i < kCount; ++i) found.squares_left -= own[i] * right[i];
    }
    return found;
  }

  /// The share by which each damper's force, predicted without its design, is off.
  std::vector<double> strengths(const GeometryRidges& ridges) const {
    const std::size_t n = problem_.unknowns();
    std::vector<double> found;
    for (std::size_t d = 0; d < dampers_.size(); ++d) {
      const std::vector<double> step = step_without(design_of_[d], ridges);
      if (step.empty()) return {};
      const std::size_t own = PhysicsProblem::kOffset + 1 + d;
      double right = dampers_[d].right[own];
      for (std::size_t u = 0; u < n; ++u) right += dampers_[d].matrix[own * n + u] * step[u];
      found.push_back(-right / dampers_[d].matrix[own * n + own]);
    }
    return found;
  }

 private:
  static constexpr std::size_t kCount = FamilyPhysics::kDeviations;

  /// Each deviation of a damper as the column of the unknown that does the same to it. The springs
  /// stand in two numbers: that before the flow, and the seal's give, which goes the other way.
  std::vector<double> deviation_columns(std::size_t damper) const {
    std::vector<double> select(problem_.unknowns() * kCount);
    select[(PhysicsProblem::kOffset + 1 + damper) * kCount + 0] = 1;
    select[kYieldShare * kCount + 1] = select[kViscousShare * kCount + 1] = 1;
    select[kStiffness * kCount + 2] = 1;
    select[kSealGive * kCount + 2] = -1;
    select[PhysicsProblem::kOffset * kCount + 3] = 1;
    return select;
  }

  const PhysicsProblem& problem_;
  std::vector<double> x_;
  std::vector<Normal> dampers_, designs_;
  Normal all_;
  std::vector<std::size_t> design_of_;
};

GeometryRidges best_ridges(const LeftOutDesigns& left_out) {
  GeometryRidges best;
  double least = INFINITY;
  for (const double all : kAllRidges)
    for (const double yield : kYieldRidges)
      for (const double spring : kSpringRidges) {
        const GeometryRidges ridges{all, yield, spring};
        const double cost = left_out.cost(ridges);
        if (!(cost < least)) continue;
        least = cost;
        best = ridges;
      }
  return best;
}

/// The spread of builds: of those of one drawing where builds repeat, of all about the family else.
void add_spreads(const FamilyGroups& groups, const std::vector<double>& strengths,
                 FamilyPhysicsFit& fit) {
  // The mean strength of each drawing's builds, and what these differ by from it.
  std::vector<double> mean(groups.drawings), builds(groups.drawings);
  for (std::size_t d = 0; d < strengths.size(); ++d) ++builds[groups.drawing_of[d]];
  for (std::size_t d = 0; d < strengths.size(); ++d)
    mean[groups.drawing_of[d]] += strengths[d] / builds[groups.drawing_of[d]];
  double within = 0, about_family = 0;
  for (std::size_t d = 0; d < strengths.size(); ++d) {
    within += std::pow(strengths[d] - mean[groups.drawing_of[d]], 2);
    about_family += strengths[d] * strengths[d];
  }

  // Its root mean square with the interval of chi squared.
  fit.builds_repeat = groups.dampers > groups.drawings;
  const auto freedom =
      static_cast<double>(fit.builds_repeat ? groups.dampers - groups.drawings : groups.dampers);
  const double square = (fit.builds_repeat ? within : about_family) / freedom;
  fit.build_spread = std::sqrt(square);
  fit.spread_low = std::sqrt(square * freedom / chi_squared_quantile(freedom, 0.975));
  fit.spread_high = std::sqrt(square * freedom / chi_squared_quantile(freedom, 0.025));

  // The means of drawings scatter by what the family gets wrong and by what is left of their
  // builds.
  if (!fit.builds_repeat) return;
  double wrong = 0;
  for (std::size_t k = 0; k < groups.drawings; ++k)
    wrong += (mean[k] * mean[k] - square / builds[k]) / static_cast<double>(groups.drawings);
  fit.drawing_spread = std::sqrt(std::max(0., wrong));
}

/// The spread of builds, and what is expected of a new one before it is measured.
void add_builds(const LeftOutDesigns& left_out, const GeometryRidges& ridges,
                FamilyPhysicsFit& fit) {
  if (const std::vector<double> strengths = left_out.strengths(ridges); !strengths.empty())
    add_spreads(left_out.groups(), strengths, fit);

  // The residuals are weighted so that the squares of all records sum to a mean square share.
  constexpr double kLeastRecordError = 0.005;
  const LeftOutDesigns::Deviated deviated = left_out.deviations(ridges);
  if (deviated.deviations.empty()) return;
  constexpr std::size_t n = FamilyPhysics::kDeviations;
  for (const FamilyPhysics::Deviation& deviation : deviated.deviations)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        fit.physics.covariance[i * n + j] +=
            deviation[i] * deviation[j] / static_cast<double>(deviated.deviations.size());
  fit.physics.record_error =
      std::max(kLeastRecordError, std::sqrt(std::max(0., deviated.squares_left)));
  fit.physics.information = left_out.information(ridges, fit.physics);
}

}  // namespace

FamilyPhysicsFit fit_family_physics(const std::vector<FamilyRecord>& records, int threads,
                                    const Monitor& monitor) {
  // Fit with ridges from the middle, then with those that leaving designs out would choose there.
  const PhysicsProblem problem(records, threads, monitor);
  GeometryRidges ridges{kAllRidges[1], kYieldRidges[1], kSpringRidges[1]};
  LeastSquaresReport report = problem.solve_with(ridges, problem.start(), kPhysicsIterations);
  const bool several = problem.groups().designs > 1;
  if (several) {
    ridges = best_ridges(LeftOutDesigns(problem, report.x));
    report = problem.solve_with(ridges, report.x, kLastIterations);
  }

  FamilyPhysicsFit fit;
  fit.physics = problem.physics_of(report.x);
  fit.offset = problem.offset_of(report.x);
  fit.ridges = ridges;
  fit.converged = report.converged;
  fit.iterations = report.iterations;
  if (several) add_builds(LeftOutDesigns(problem, report.x), ridges, fit);
  return fit;
}

}  // namespace dashpot
