#include "dashpot/damper/kinds/family/family_member.h"

#include <array>
#include <cmath>

#include "dashpot/damper/inverse/observer.h"
#include "dashpot/physics/damper_physics.h"
#include "example_family.h"
#include "support.h"

using namespace dashpot;

TEST_CASE(
    "a yield stress is straight between its points, held beyond them and even in the current") {
  const YieldCurve curve{{0, 0.5, 1}, {2000, 30000, 50000}};
  CHECK(curve.at(0) == 2000);
  CHECK_CLOSE(curve.at(0.25), 16000, 1e-14, 0);
  CHECK_CLOSE(curve.at(-0.75), 40000, 1e-14, 0);
  CHECK(curve.at(9) == 50000);
  CHECK(YieldCurve{{0}, {700}}.at(3) == 700);
}

TEST_CASE("conditions replace a member's numbers, and others are passed over") {
  const FamilyMember member = with_conditions(
      example_member(), {{"gap", 2e-3}, {"yield_stress", 900}, {"temperature", 300}}, "r");
  CHECK(member.gap == 2e-3);
  CHECK(member.pole_length == 6e-3);
  CHECK(member.yield.at(1) == 900);
}

TEST_CASE("conditions that cannot be are refused in words") {
  CHECK(message_of([] { with_conditions({}, {{"gap", -1}}, "r"); }).find("gap is -1") !=
        std::string::npos);
  CHECK(message_of([] { with_conditions({}, {{"yield_stress", -1}}, "r"); }).find("-1 Pa") !=
        std::string::npos);
  // Written in mm and mm^2: a drawing may not have them either.
  CHECK(message_of([] { with_conditions({}, {{"gap", 1.2}}, "r"); }) ==
        "r: gap is 1.2 m; 5e-05 ... 0.01 m");
  CHECK(message_of([] {
          with_conditions({}, {{"piston_area", 160}}, "r");
        }).find("piston_area is 160 m^2") != std::string::npos);
  CHECK(message_of([] {
          FamilyMember member = example_member();
          member.pole_length = 9;
          read_member(to_json(member));
        }).find("pole_length is 9 m") != std::string::npos);
  CHECK(message_of([] {
          require_member({{"gap", 1e-3}}, "run 7");
        }).find("run 7: has no condition") == 0);
}

TEST_CASE("a drawing makes a member with the physics' own numbers") {
  const DamperDescription description = named_description(description_names().front());
  const FamilyMember member = member_of(description, 1);
  const DamperPhysics physics = evaluate_physics(description, {.current = 0.5});
  CHECK(member.piston_area == physics.piston_area);
  CHECK(member.gap_area == physics.gap_area);
  CHECK(member.viscosity == physics.viscosity);
  CHECK_CLOSE(member.yield.at(0.5), physics.yield_stress, 1e-12, 0);
}

TEST_CASE("a member's coil lags its command, as its drawing says, and without it follows at once") {
  const DamperDescription drawn = named_description("family_prototype");
  const FamilyMember member = member_of(drawn, 1);
  CHECK_CLOSE(member.lag_rate, 1 / evaluate_physics(drawn, {.current = 1}).time_constant, 1e-12, 0);
  CHECK(read_member(to_json(member)).lag_rate == member.lag_rate);
  CHECK(member_of(drawn, std::array{0.}).lag_rate == 0);
  CHECK(message_of([&] {
          Value value = to_json(member_of(drawn, std::array{0.}));
          value.add("lag_rate", -1);
          read_member(value);
        }).find("lag_rate is -1") != std::string::npos);

  // One time constant after a step of the command the coil has 63 % of it.
  const FamilyModel model = example_family_lag();
  const double lag = 1 / model.member().lag_rate;
  std::vector<double> state(model.state_size()), plain(model.state_size() - 1);
  model.rest({0, 0, 0}, state);
  model.advance({0, 0, 1}, {0, 0, 1}, lag, state);
  CHECK_CLOSE(state.back(), 1 - std::exp(-1.), 1e-12, 0);
  const auto bare = model.without_lag();
  const DamperInput coil{0, 0.05, state.back()};
  bare->rest({0, 0, 0}, plain);
  CHECK(model.force({0, 0.05, 1}, state) == bare->force(coil, std::span(state).first(3)));
  const BareDamper taken = without_coil_lag(model);
  CHECK(taken.lag_rate == model.member().lag_rate);
  CHECK(taken.model->state_size() == 3);
}
