#include "dashpot/design/next_drawings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "dashpot/base/parallel.h"
#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/family/physics_information.h"
#include "dashpot/design/design_problem.h"
#include "dashpot/error.h"
#include "dashpot/numerics/latin_hypercube.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/numerics/median.h"

namespace dashpot {
namespace {

/// Of each range, about its middle, so much is proposed. A model is not the truth, and what it gets
/// wrong at the ends it carries into the middle: the drawings that do least harm have about the
/// second moments of the region (Box and Draper), which are 0.58 of the way to the ends.
constexpr double kInner = 0.7;
constexpr double kNinety = 1.6449;  // standard deviations, either way, that hold 90 %

/// The places of a request as drawings, without its goals and constraints.
class DrawingSpace {
 public:
  explicit DrawingSpace(const DesignRequest& request)
      : request_(without_requirements(request)),
        physics_(make_design_model("physics", "the request")),
        problem_(request_, *physics_, 1) {}

  std::size_t size() const { return problem_.size(); }
  const DesignVariable& variable(std::size_t k) const { return request_.variables[k]; }

  /// Adds the drawing at a place, unless it is not possible or there already. `part`: of the
  /// ranges, about their middle, to which the place belongs.
  void add(std::vector<double> place, double part, std::vector<DamperDescription>& drawings) {
    for (double& at : place) at = 0.5 + part * (at - 0.5);
    const DamperDescription damper = problem_.damper_at(place);
    if (problem_.assess(damper).possible && known_.insert(format_description(damper)).second)
      drawings.push_back(damper);
  }

 private:
  static DesignRequest without_requirements(DesignRequest request) {
    request.goals.clear();
    request.constraints.clear();
    request.share = 0;
    return request;
  }

  DesignRequest request_;
  std::unique_ptr<DesignModel> physics_;
  DesignProblem problem_;
  std::set<std::string> known_;
};

/// Every combination of the variables at so many places each, from end to end of the inner ranges.
void add_grid(DrawingSpace& space, const std::vector<std::size_t>& levels,
              std::vector<DamperDescription>& drawings) {
  std::vector<std::size_t> at(space.size(), 0);
  while (true) {
    std::vector<double> place;
    for (std::size_t v = 0; v < at.size(); ++v)
      place.push_back(
          levels[v] > 1 ? static_cast<double>(at[v]) / static_cast<double>(levels[v] - 1) : 0.5);
    space.add(std::move(place), kInner, drawings);
    std::size_t v = 0;
    while (v < at.size() && ++at[v] == levels[v]) at[v++] = 0;
    if (v == at.size()) return;
  }
}

/// A test as a damper is moved through it: from rest at the lower end, scored after a half cycle.
struct TestRun {
  std::vector<DamperInput> inputs;
  std::vector<double> time;
  std::size_t first = 0;
};
TestRun run_of(const DrawingTest& test) {
  constexpr std::size_t kOfCycle = 48;
  const double rate = 2 * std::numbers::pi * test.motion.frequency;
  TestRun run;
  run.first = kOfCycle / 2;
  for (std::size_t k = 0; k <= run.first + kOfCycle; ++k) {
    const double t = static_cast<double>(k) / (test.motion.frequency * kOfCycle);
    run.time.push_back(t);
    run.inputs.push_back({-test.motion.amplitude * std::cos(rate * t),
                          test.motion.amplitude * rate * std::sin(rate * t), test.current});
  }
  return run;
}

using Matrix = std::vector<double>;
void add_to(Matrix& sum, const Matrix& part, double factor = 1) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += factor * part[k];
}

/// What the tests of drawings tell, and what is to be known of the region.
class NextChoice {
 public:
  NextChoice(const FamilyPhysics& physics, double offset, const NextOptions& options)
      : physics_(physics), offset_(offset), options_(options) {
    for (const DrawingTest& test : options.tests) runs_.push_back(run_of(test));
    for (const DrawingTest& test : options.tests) {
      if (std::ranges::find(currents_, std::abs(test.current)) == currents_.end())
        currents_.push_back(std::abs(test.current));
    }
    std::ranges::sort(currents_);
  }

  FamilyMember member(const DamperDescription& damper) const {
    return member_of(damper, currents_);
  }

  /// J'J of each test of each drawing.
  std::vector<std::vector<Matrix>> sensitivities(
      const std::vector<DamperDescription>& drawings) const {
    std::vector<std::vector<Matrix>> all(drawings.size());
    parallel_for(drawings.size(), options_.threads, [&](std::size_t d) {
      options_.monitor.check();
      const FamilyMember one = member(drawings[d]);
      for (const TestRun& run : runs_)
        all[d].push_back(test_sensitivity(physics_, offset_, one, run.inputs, run.time, run.first));
    });
    return all;
  }

  /// The region is the mean over drawings and tests.
  void set_region(const std::vector<std::vector<Matrix>>& drawings) {
    Matrix mean(kTestRows * kTestRows);
    for (const std::vector<Matrix>& tests : drawings)
      for (const Matrix& test : tests)
        add_to(mean, test, 1 / static_cast<double>(drawings.size() * tests.size()));
    region_.assign(kPhysicsUnknowns * kPhysicsUnknowns, 0);
    for (std::size_t i = 0; i < kPhysicsUnknowns; ++i)
      for (std::size_t j = 0; j < kPhysicsUnknowns; ++j)
        region_[i * kPhysicsUnknowns + j] = mean[i * kTestRows + j];

    // Of a damper that deviates, and a record's error.
    constexpr std::size_t kOwn = FamilyPhysics::kDeviations;
    double square = physics_.record_error * physics_.record_error;
    for (std::size_t i = 0; i < kOwn; ++i)
      for (std::size_t j = 0; j < kOwn; ++j)
        square += physics_.covariance[i * kOwn + j] *
                  mean[(kPhysicsUnknowns + i) * kTestRows + kPhysicsUnknowns + j];
    builds_ = kNinety * std::sqrt(square);
  }
  double builds() const { return builds_; }

  /// The band over the region with this information; infinite where it leaves something open.
  double band(const Matrix& information) const {
    double trace = 0;
    const Matrix covariance = inverse(information, kPhysicsUnknowns);
    for (std::size_t k = 0; k < covariance.size(); ++k) trace += covariance[k] * region_[k];
    return trace >= 0 ? kNinety * std::sqrt(trace) : INFINITY;
  }

  Matrix information(const std::vector<Matrix>& tests) const {
    Matrix sum(kTestRows * kTestRows);
    for (const Matrix& test : tests) add_to(sum, test);
    return damper_information(physics_, sum);
  }

 private:
  const FamilyPhysics& physics_;
  double offset_;
  const NextOptions& options_;
  std::vector<TestRun> runs_;
  std::vector<double> currents_;
  Matrix region_;
  double builds_ = 0;
};

/// The candidate, not among those chosen, that leaves the least band beside this information.
std::size_t best_beside(const NextChoice& choice, const std::vector<Matrix>& told,
                        const Matrix& before, const std::vector<std::size_t>& chosen) {
  std::size_t best = told.size();
  double least = INFINITY;
  for (std::size_t c = 0; c < told.size(); ++c) {
    if (std::ranges::find(chosen, c) != chosen.end()) continue;
    Matrix with = before;
    add_to(with, told[c]);
    const double band = choice.band(with);
    if (best < told.size() && band >= least) continue;
    least = band;
    best = c;
  }
  return best;
}

/// Picks candidates one by one, exchanges each for a better one while that gains, and puts them in
/// the order in which they tell most.
std::vector<std::size_t> choose(const NextChoice& choice, const std::vector<Matrix>& told,
                                const Matrix& before, std::size_t count) {
  constexpr int kRounds = 5;
  std::vector<std::size_t> chosen;
  Matrix all = before;
  const auto take = [&](std::size_t candidate) {
    chosen.push_back(candidate);
    add_to(all, told[candidate]);
  };
  while (chosen.size() < count) take(best_beside(choice, told, all, chosen));

  // The oldest goes and the best beside the others comes: a round that changes nothing is the last.
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t old = chosen.front();
      chosen.erase(chosen.begin());
      add_to(all, told[old], -1);
      take(best_beside(choice, told, all, chosen));
      changed = changed || chosen.back() != old;
    }
    if (!changed) break;
  }

  // In order: among those chosen, each in turn that tells most beside those before it.
  std::vector<Matrix> of_chosen;
  for (const std::size_t c : chosen) of_chosen.push_back(told[c]);
  std::vector<std::size_t> order, ordered;
  Matrix now = before;
  while (order.size() < count) {
    order.push_back(best_beside(choice, of_chosen, now, order));
    add_to(now, of_chosen[order.back()]);
    ordered.push_back(chosen[order.back()]);
  }
  return ordered;
}

/// The tests of one drawing, the one that tells most first.
void order_tests(const NextChoice& choice, const std::vector<Matrix>& tests, const Matrix& before,
                 NextDrawing& drawing) {
  std::vector<Matrix> done;
  while (drawing.tests.size() < tests.size()) {
    double least = INFINITY;
    std::size_t best = tests.size();
    for (std::size_t t = 0; t < tests.size(); ++t) {
      if (std::ranges::find(drawing.tests, t) != drawing.tests.end()) continue;
      std::vector<Matrix> with = done;
      with.push_back(tests[t]);
      Matrix all = before;
      add_to(all, choice.information(with));
      const double band = choice.band(all);
      if (best < tests.size() && band >= least) continue;
      least = band;
      best = t;
    }
    drawing.tests.push_back(best);
    drawing.band_after.push_back(least);
    done.push_back(tests[best]);
  }
}

/// The band that the drawings leave when all of them are recorded.
double band_with(const NextChoice& choice, const Matrix& before,
                 const std::vector<Matrix>& drawings) {
  Matrix all = before;
  for (const Matrix& drawing : drawings) add_to(all, drawing);
  return choice.band(all);
}

}  // namespace

std::vector<DamperDescription> random_drawings(const DesignRequest& request, std::size_t count,
                                               std::uint64_t seed) {
  DrawingSpace space(request);
  std::vector<DamperDescription> drawings;
  for (const std::vector<double>& place : latin_hypercube(count, space.size(), seed))
    space.add(place, 1, drawings);
  return drawings;
}

std::vector<DamperDescription> grid_drawings(const DesignRequest& request, std::size_t count) {
  // One more place for each variable in turn until there are enough.
  DrawingSpace space(request);
  std::vector<std::size_t> levels(space.size(), 1);
  std::size_t all = 1;
  for (std::size_t v = 0, held = 0; all < count && held < space.size();
       v = (v + 1) % space.size()) {
    const std::size_t most = space.variable(v).levels();
    held = most > 0 && levels[v] == most ? held + 1 : 0;
    if (held > 0) continue;
    all = all / levels[v] * (levels[v] + 1);
    ++levels[v];
  }

  // Of more than enough, some all along the grid.
  std::vector<DamperDescription> grid, drawings;
  add_grid(space, levels, grid);
  for (std::size_t k = 0; k < std::min(count, grid.size()); ++k)
    drawings.push_back(grid[k * grid.size() / std::min(count, grid.size())]);
  return drawings;
}

NextReport next_drawings(const DesignRequest& request, const FamilyModel& family,
                         const NextOptions& options) {
  constexpr std::size_t kCandidates = 60, kRegion = 40, kMostOfGrid = 243, kDraws = 100;
  const auto* force = dynamic_cast<const PhysicsFamily*>(family.family().force.get());
  if (!force || force->physics().information.empty())
    throw Error(family.name(), "does not know what its recordings have told",
                "a family_physics that was fitted on two designs or more");
  require_field(request.damper, "the request's damper");
  FamilyPhysics physics = force->physics();
  physics.deviation = {};  // of the family, not of one build

  // Candidates: the ends and middles of the inner ranges, where these are not too many, and
  // drawings by chance between them. The region has drawings of its own.
  DrawingSpace space(request);
  std::vector<DamperDescription> drawings;
  std::vector<std::size_t> levels(space.size(), 3);
  std::size_t of_grid = 1;
  for (std::size_t v = 0; v < space.size() && of_grid <= kMostOfGrid; ++v) {
    if (const std::size_t own = space.variable(v).levels(); own > 0)
      levels[v] = std::min<std::size_t>(own, 3);
    of_grid *= levels[v];
  }
  if (of_grid <= kMostOfGrid) add_grid(space, levels, drawings);
  for (const std::vector<double>& place :
       latin_hypercube(std::max(kCandidates, 4 * options.count), space.size(), options.seed))
    space.add(place, kInner, drawings);
  const std::vector<DamperDescription> region = random_drawings(request, kRegion, options.seed + 1);
  const std::vector<DamperDescription> grid = grid_drawings(request, options.count);
  if (drawings.size() < options.count || region.empty())
    throw Error("the request",
                "has " + std::to_string(drawings.size()) + " possible drawings, and " +
                    std::to_string(options.count) + " are wanted",
                "fewer, or wider ranges");

  // What each candidate's recording would tell, and what is to be known.
  options.monitor.report("what a drawing would tell", 0);
  NextChoice choice(physics, family.offset(), options);
  const std::vector<std::vector<Matrix>> tests = choice.sensitivities(drawings);
  options.monitor.report("what is to be known", 0.6);
  const std::vector<std::vector<Matrix>> of_region = choice.sensitivities(region);
  choice.set_region(of_region);
  std::vector<Matrix> told, told_by_chance, told_by_grid;
  for (const std::vector<Matrix>& of_drawing : tests)
    told.push_back(choice.information(of_drawing));
  for (const std::vector<Matrix>& of_drawing : of_region)
    told_by_chance.push_back(choice.information(of_drawing));
  for (const std::vector<Matrix>& of_drawing : choice.sensitivities(grid))
    told_by_grid.push_back(choice.information(of_drawing));

  // The choice, drawing by drawing, and the tests of each.
  options.monitor.report("choosing", 0.9);
  NextReport report;
  report.candidates = drawings.size();
  report.builds = choice.builds();
  Matrix now = physics.information;
  report.before = choice.band(now);
  for (const std::size_t c : choose(choice, told, now, options.count)) {
    NextDrawing next;
    next.damper = drawings[c];
    next.outside = family.with_outside(OutsideFamily::Mark)
                       ->with_member(choice.member(drawings[c]))
                       ->extrapolations();
    order_tests(choice, tests[c], now, next);
    add_to(now, told[c]);
    next.band = choice.band(now);
    report.drawings.push_back(std::move(next));
  }

  // Beside it: as many of the grid, and as many by chance.
  report.grid = band_with(choice, physics.information, told_by_grid);
  Random random(options.seed + 2);
  std::vector<double> draws;
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    std::vector<Matrix> some;
    std::set<std::size_t> taken;
    while (taken.size() < std::min(options.count, told_by_chance.size()))
      taken.insert(random.index(told_by_chance.size()));
    for (const std::size_t c : taken) some.push_back(told_by_chance[c]);
    draws.push_back(band_with(choice, physics.information, some));
  }
  report.random = median(std::move(draws));
  return report;
}

}  // namespace dashpot
