#include "dashpot/design/design_problem.h"

#include <cmath>
#include <limits>

#include "dashpot/design/optimise.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A fitted model of set forces, with or without a refusal.
class SetModel final : public DesignModel {
 public:
  double force = 1, off_force = 1;
  Refusal refusal = Refusal::None;

  std::string name() const override { return "set"; }
  Appraisal appraise(const DamperDescription& description,
                     const DamperOperation& operation) const override {
    Appraisal told{.physics = evaluate_physics(description, operation), .refusal = refusal};
    told.physics.force = force;
    told.physics.off_force = off_force;
    told.physics.dynamic_range = force / off_force;
    return told;
  }
  bool is_fitted() const override { return true; }
};

/// Counts how often a time of response was looked for; there is none below a gap.
class CountingModel final : public DesignModel {
 public:
  double least_gap = 0;
  mutable int responses = 0;

  std::string name() const override { return "counting"; }
  Appraisal appraise(const DamperDescription& description,
                     const DamperOperation& operation) const override {
    Appraisal told{.physics = evaluate_physics(description, operation)};
    if (description.gap < least_gap) told.physics.force = told.physics.off_force;
    return told;
  }
  double force(const DamperDescription& description, const DamperOperation& at) const override {
    ++responses;  // a straight line, on which the first look is the last
    const DamperPhysics end = evaluate_physics(description, {1, at.velocity});
    return end.off_force + at.current * (end.force - end.off_force);
  }
  bool is_fitted() const override { return true; }
};

DesignRequest problem_request(const std::string& requirements) {
  return parse_request(
      "damper: passenger_car\nat: {current: 1 A, velocity: 0.1 m/s}\n"
      "vary: {gap: {from: 1 mm, to: 2 mm}}\n" +
          requirements,
      "request.yaml");
}

Assessment assessed(const DesignRequest& asked, const SetModel& model) {
  return DesignProblem(asked, model, 1).assess(asked.damper);
}

}  // namespace

TEST_CASE("a refused drawing says why, and is not made; one without a refusal is judged") {
  for (const char* made : {"", "tolerances: {gap: 0.05 mm}\nrobust: {share: 0.9, samples: 4}\n"}) {
    const DesignRequest asked = problem_request(
        std::string(made) + "constraints: [{quantity: mass, max: 100}]\ngoals: [{maximise: gap}]");
    SetModel model;
    CHECK(assessed(asked, model).holds());
    CHECK(assessed(asked, model).refusal == Refusal::None);
    model.refusal = Refusal::RangeLeap;
    const Assessment told = assessed(asked, model);
    CHECK(told.refusal == Refusal::RangeLeap);
    CHECK(told.possible);
    CHECK_FALSE(told.known);
    CHECK_FALSE(told.holds());
    CHECK(std::isnan(told.goals.front()));
  }
}

TEST_CASE("a figure that is not finite holds no bound, and is no goal's, and is no refusal") {
  const double infinite = std::numeric_limits<double>::infinity(), unknown = std::nan("");
  const DesignRequest bounds = problem_request(
      "constraints: [{quantity: dynamic_range, min: 1}, {quantity: off_force, max: 10}]\n"
      "goals: [{maximise: gap}]");
  const DesignRequest goal = problem_request("goals: [{maximise: dynamic_range}]");
  SetModel model;
  CHECK(assessed(bounds, model).holds());
  CHECK(assessed(goal, model).holds());

  // A range without end, a force without a figure, one of minus infinity, which is at most 10.
  for (const auto& [force, off_force] :
       {std::pair{1., 0.}, {infinite, 1.}, {unknown, 1.}, {1., -infinite}, {1., unknown}}) {
    CAPTURE(force);
    CAPTURE(off_force);
    model.force = force;
    model.off_force = off_force;
    const Assessment told = assessed(bounds, model);
    CHECK(told.violation > 1);
    CHECK_FALSE(told.holds());
    CHECK(told.refusal == Refusal::None);
    if (!std::isfinite(force / off_force)) {
      CHECK_FALSE(assessed(goal, model).known);
      CHECK_FALSE(assessed(goal, model).holds());
    }
  }
}

TEST_CASE("a search for one goal looks at others where a place is better than any before") {
  const DesignRequest both = problem_request("goals: [{minimise: gap}, {minimise: response_time}]"),
                      alone = problem_request("goals: [{minimise: gap}]");
  CountingModel model;
  const OptimiseOptions options{.threads = 1};
  const Optimum of_both = optimise(DesignProblem(both, model, 1), 0, options);
  CHECK(model.responses > 0);
  CHECK(model.responses < of_both.evaluations / 10);
  CHECK(of_both.place == optimise(DesignProblem(alone, model, 1), 0, options).place);

  // A place at which another goal has no figure is none.
  model.least_gap = 1.5e-3;
  const DesignProblem problem(both, model, 1);
  const Optimum with_figures = optimise(problem, 0, options);
  CHECK(with_figures.violation == 0);
  CHECK_CLOSE(problem.damper_at(with_figures.place).gap, 1.5e-3, 1e-3, 0);
}
