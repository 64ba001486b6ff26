#include "dashpot/design/design_problem.h"

#include <cmath>
#include <limits>

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
