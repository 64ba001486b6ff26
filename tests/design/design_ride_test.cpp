#include <atomic>
#include <cmath>

#include "damper/kinds/family/example_family.h"
#include "dashpot/design/design.h"
#include "dashpot/design/design_law.h"
#include "dashpot/design/design_problem.h"
#include "dashpot/machine/comfort_ride.h"
#include "dashpot/report/design_report.h"
#include "dashpot/suspension/ride/simulated_run.h"
#include "resisting_family.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr const char* kCar = R"(
damper: passenger_car
at: {current: 2 A, velocity: 0.3 m/s}
vary: {gap: {from: 0.8 mm, to: 2 mm}}
)";

DesignRequest parsed(const std::string& rest) {
  return parse_request(kCar + rest, "request.yaml", {}, Goals::Required, read_comfort_ride);
}
DesignReport ridden_design(const std::string& rest, DesignOptions options = {}) {
  options.threads = 1;
  return design(parsed(rest), options);
}

/// Counts how often it was driven.
class CountingRide final : public DesignRide {
 public:
  std::string description() const override { return "a count"; }
  double comfort(const ModelFile&) const override { return static_cast<double>(++rides); }
  mutable int rides = 0;
};

/// How far the damper's greatest damping force is from a wanted one, in place of a ride; counts how
/// often it was asked, from any thread.
class ForceRide final : public DesignRide {
 public:
  explicit ForceRide(double wanted) : wanted_(wanted) {}
  std::string description() const override { return "a force"; }
  double comfort(const ModelFile& file) const override {
    ++rides;
    const DamperInput input{0, 0.3, 1};
    std::vector<double> state(file.model->state_size());
    file.model->rest(input, state);
    return std::abs(file.model->force(input, state) - wanted_);
  }
  mutable std::atomic<int> rides = 0;

 private:
  double wanted_;
};

/// The a_w of a drawing in that ride, by the law that its model file holds.
double comfort_of(const DamperDescription& damper, const DesignRequest& request) {
  const auto physics = make_design_model("physics", "");
  VehicleWords words;
  words.plant = "savaresi_spelta";
  words.controller = "skyhook";
  const auto vehicle = std::make_shared<const Vehicle>(
      make_vehicle(words, law_of_design(damper, request, *physics).file));
  const GroundPointer road = make_ground("iso8608,class=D", 3, "");
  return measure_named(run_vehicle(vehicle, *road, {.duration = 2}).measures,
                       "weighted_acceleration");
}

}  // namespace

TEST_CASE("a design for comfort: the drawing whose damper rides best in its plant" *
          doctest::test_suite("long")) {
  const DesignReport report = ridden_design(
      "ride: {plant: savaresi_spelta, controller: skyhook, road: 'iso8608,class=D', seed: 3, "
      "duration: 2 s}\ngoals: [{minimise: comfort}]");
  REQUIRE(report.designs.size() == 1);
  const Design& best = report.designs.front();
  CHECK_CLOSE(best.assessment.goals.front(), comfort_of(best.damper, report.request), 1e-9, 0);
  for (const double gap : {0.8e-3, 1.2e-3, 1.6e-3, 2e-3}) {
    DamperDescription other = best.damper;
    other.gap = gap;
    CAPTURE(gap);
    CHECK(comfort_of(other, report.request) >= best.assessment.goals.front() * (1 - 1e-3));
  }
  CHECK(contains(report.notes.front(), "comfort is that of savaresi_spelta"));
  CHECK(contains(report.notes.front(), "by skyhook"));
}

TEST_CASE("a constraint on comfort holds, or what could be reached is said; of a family as well" *
          doctest::test_suite("long")) {
  const std::string ride = "ride: {plant: savaresi_spelta, current: 0.5 A, duration: 0.3 s}\n";
  const DesignReport held = ridden_design(
      ride + "constraints: [{quantity: comfort, max: 10}]\ngoals: [{minimise: mass}]");
  REQUIRE(!held.designs.empty());
  CHECK(held.designs.front().assessment.constraints.front() < 10);
  const DesignReport none = ridden_design(
      ride + "constraints: [{quantity: comfort, max: 0.001}]\ngoals: [{minimise: mass}]");
  CHECK(none.designs.empty());
  REQUIRE(none.conflict);
  CHECK(contains(describe(*none.conflict, none.request), "comfort at most 0.001 m/s^2"));

  // A member of a family rides as the model that it is, not as a law.
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "family.json").string();
  save_model(
      {.model = resisting_family().with_offset(0), .domain = {-0.02, 0.02, -0.05, 0.05, 0, 1}},
      file);
  const DesignRequest request = parsed(ride + "goals: [{minimise: comfort}]");
  const auto family = make_design_model(file, "");
  const DamperPhysics physics = family->evaluate(request.damper, {0.5, 0.02});
  const double told = find_design_quantity("comfort", "")
                          .of({request.damper, {0.5, 0.02}, physics, *family, &request});
  CHECK_CLOSE(told, request.ride->comfort(*family->model_of(request.damper)), 1e-12, 0);
  CHECK(told > 0);
}

TEST_CASE("what constraints alone cannot reach is said without a single ride") {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "family.json").string();
  save_model(
      {.model = resisting_family().with_offset(0), .domain = {-0.02, 0.02, -0.05, 0.05, 0, 1}},
      file);
  for (const std::string& model : {std::string("physics"), file})
    for (const char* const robust :
         {"", "tolerances: {gap: 0.05 mm}\nrobust: {share: 0.9, samples: 4}\n"}) {
      CAPTURE(model);
      CAPTURE(robust);
      DesignRequest request = parsed(
          "ride: {plant: savaresi_spelta}\nconstraints: [{quantity: force, min: 1e6 N}]\n"
          "goals: [{minimise: comfort}]\n" +
          std::string(robust));
      const auto ride = std::make_shared<CountingRide>();
      request.ride = ride;
      const DesignReport report = design(request, {.threads = 1, .model = model});
      CHECK(report.designs.empty());
      REQUIRE(report.conflict);
      CHECK(contains(describe(*report.conflict, report.request), "force at least 1e+06 N"));
      CHECK(ride->rides == 0);
    }
}

TEST_CASE("nothing is ridden where constraints without a ride already rule a damper out") {
  // The share of the looks that were rides.
  const auto ridden = [](const std::string& constraints) {
    DesignRequest request =
        parsed("ride: {plant: savaresi_spelta}\n" + constraints + "goals: [{minimise: comfort}]");
    const auto ride = std::make_shared<ForceRide>(1500);
    request.ride = ride;
    const DesignReport report = design(request, {.threads = 1});
    REQUIRE(report.designs.size() == 1);
    return ride->rides / static_cast<double>(report.evaluations);
  };
  CHECK(ridden("") >= 1);
  CHECK(ridden("constraints: [{quantity: gap, max: 1 mm}]\n") < 0.8);
}

TEST_CASE("a robust design rides the drawing first, and the dampers made near its best" *
          doctest::test_suite("long")) {
  DesignRequest request = parsed(
      "ride: {plant: savaresi_spelta}\ntolerances: {gap: 0.1 mm}\n"
      "robust: {share: 0.9, samples: 16}\ngoals: [{minimise: comfort}]");
  const auto ride = std::make_shared<ForceRide>(1200);
  request.ride = ride;
  const DesignReport report = design(request, {.threads = 1});
  REQUIRE(report.designs.size() == 1);
  CHECK(ride->rides < 16 * 20 + 3 * 48 + static_cast<int>(report.evaluations));
  const double found = report.designs.front().assessment.goals.front();

  // No gap of a fine grid is better, though the best as drawn has no distance at all.
  const auto physics = make_design_model("physics", "");
  const DesignProblem problem(request, *physics, 1);
  double best = INFINITY, best_drawn = INFINITY;
  for (int k = 0; k <= 200; ++k) {
    const std::vector<double> place{k / 200.};
    const DamperDescription damper = problem.damper_at(place);
    best = std::min(best, problem.assess(damper).goals.front());
    best_drawn = std::min(best_drawn, problem.riding(Ridden::Drawn).assess(damper).goals.front());
  }
  CHECK(best_drawn < 0.1 * best);
  CHECK(found <= 1.01 * best);
}

TEST_CASE("a robust design for comfort by two models rides each damper made, by both" *
          doctest::test_suite("long")) {
  const DesignReport report = ridden_design(
      "tolerances: {gap: 0.05 mm}\nrobust: {share: 0.9, samples: 4}\n"
      "ride: {plant: savaresi_spelta, current: 0.5 A, duration: 0.3 s}\n"
      "constraints: [{quantity: comfort, max: 10, by: both}]\ngoals: [{minimise: comfort}]",
      {.second = "physics:moving_wall"});
  REQUIRE(report.designs.size() == 1);
  const Design& best = report.designs.front();

  // What both models tell of the drawing, beside the worst of the dampers made, some of which have
  // less of a gap and some more.
  const auto comfort_by = [&](const char* name) {
    const auto model = make_design_model(name, "");
    return report.request.ride->comfort(law_of_design(best.damper, report.request, *model).file);
  };
  const double told = comfort_by("physics"), second = comfort_by("physics:moving_wall");
  CHECK_CLOSE(best.first.front(), told, 1e-9, 0);
  CHECK_CLOSE(best.second.front(), second, 1e-9, 0);
  CHECK(told != second);
  CHECK(best.assessment.goals.front() > told);
  REQUIRE(best.assessment.constraints.size() == 2);
  CHECK(best.assessment.constraints.front() == best.assessment.goals.front());
  CHECK(best.assessment.constraints.back() > second);
}

TEST_CASE("a ride that cannot be is refused before the search") {
  const auto says = [](const std::string& rest, const std::string& words) {
    CAPTURE(rest);
    const std::string message = message_of([&] { parsed(rest); });
    CAPTURE(message);
    CHECK(contains(message, words));
    CHECK(contains(message, "request.yaml"));
  };
  const std::string goal = "goals: [{minimise: comfort}]";
  says(goal, "of no ride");
  says("ride: {plant: savaresi_spelta}\ngoals: [{minimise: mass}]", "nothing is asked of the ride");
  says("ride: {plant: savaresi}\n" + goal, "savaresi_spelta");
  says("ride: {plant: dyke_spencer1996}\n" + goal, "no tyres");
  says("ride: {plant: savaresi_spelta, controller: skyhok}\n" + goal, "skyhook");
  says("ride: {plant: savaresi_spelta, road: iso86}\n" + goal, "iso8608");
  says("ride: {plant: savaresi_spelta, duration: 0}\n" + goal, "more than 0");
  says("ride: {plant: savaresi_spelta, seed: 0.5}\n" + goal, "whole number");
  says("ride: {plants: savaresi_spelta}\n" + goal, "plant");
  const std::string asked = kCar + ("ride: {plant: savaresi_spelta}\n" + goal);
  CHECK(contains(message_of([&] { parse_request(asked, "request.yaml"); }), "cannot be asked"));
}
