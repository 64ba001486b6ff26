#include "dashpot/controller.h"

#include <cmath>
#include <numbers>

#include "dashpot/plant.h"
#include "dashpot/suspension/control/damping_law.h"
#include "dashpot/suspension/control/regulator.h"
#include "dashpot/suspension/plants/linear.h"
#include "support.h"

using namespace dashpot;

namespace {

const ControlLimits kLimits{300, 3900, 0, 1, 1e-3};

/// The demand of a law for one strut's signals.
DamperDemand demand(const std::string& text, const StrutSignals& signals) {
  static const Plant plant = load_plant_set("savaresi_spelta").plant;
  const ControllerPointer controller = make_controller(text, {kLimits, plant});
  std::vector<double> state(controller->state_size());
  controller->reset(state);
  DamperDemand answer;
  controller->step(std::span(&signals, 1), {}, state, std::span(&answer, 1));
  return answer;
}

StrutSignals signals(double z, double a, double wheel, double x) {
  return {.body_velocity = z,
          .body_acceleration = a,
          .wheel_velocity = wheel,
          .deflection = x,
          .deflection_velocity = z - wheel};
}

struct Row {
  StrutSignals s;
  double skyhook, linear, groundhook, hybrid, add, pdd, sh_add, mix1, range;
};

}  // namespace

TEST_CASE("decisions of the laws: TC-7") {
  const Row rows[] = {
      {signals(0.2, 1, -0.1, 0.01), 3900, 3250, 3900, 300, 3900, 300, 3900, 3900, -4.7006835},
      {signals(0.05, -2, 0.3, -0.02), 300, 300, 3900, -300, 3900, 300, 3900, 300, 3.6437073},
      {signals(-0.1, 0.5, -0.4, -0.03), 300, 300, 3900, 400, 3900, 2000, 300, 3900, -1.1751709}};
  for (const Row& row : rows) {
    CHECK_CLOSE(demand("skyhook", row.s).value, row.skyhook, 1e-12, 0);
    CHECK_CLOSE(demand("skyhook_linear,share=0.5", row.s).value, row.linear, 1e-12, 0);
    CHECK_CLOSE(demand("groundhook", row.s).value, row.groundhook, 1e-12, 0);
    CHECK_CLOSE(demand("hybrid,gain=2000,share=0.5", row.s).value, row.hybrid, 1e-12, 0);
    CHECK_CLOSE(demand("add", row.s).value, row.add, 1e-12, 0);
    CHECK_CLOSE(demand("pdd,stiffness=20000", row.s).value, row.pdd, 1e-12, 0);
    CHECK_CLOSE(demand("sh_add,crossover=1.9", row.s).value, row.sh_add, 1e-12, 0);
    CHECK_CLOSE(demand("mix1,crossover=1.9Hz", row.s).value, row.mix1, 1e-12, 0);
    CHECK_CLOSE(frequency_range(&row.s, 1.9), row.range, 1e-7, 0);
    CHECK(demand("selector(skyhook/add),crossover=1.9", row.s).value ==
          (row.range > 0 ? demand("add", row.s) : demand("skyhook", row.s)).value);
  }
  CHECK(demand("hybrid", rows[0].s).kind == DamperDemand::Kind::Force);
  // Without a stiffness stated it is the plant's, 20 kN/m here.
  CHECK_CLOSE(demand("pdd", rows[2].s).value, 2000, 1e-12, 0);
}

TEST_CASE("modified skyhook, within the damper's cone, and the passive laws") {
  const StrutSignals s = signals(0.2, 1, -0.1, 0.01);
  // C (a d + (1 - a) z') = 2000 (0.15 + 0.1)
  CHECK_CLOSE(demand("skyhook_modified,gain=2000,share=0.5", s).value, 500, 1e-12, 0);
  CHECK_CLOSE(demand("skyhook_modified,gain=1e5", s).value, 3900 * 0.3, 1e-12, 0);
  CHECK_CLOSE(demand("constant,place=0.25", s).value, 1200, 1e-12, 0);
}

TEST_CASE("fuzzy rules: their corners, and no leap between them") {
  // Full velocities of 0.2 and 0.4 m/s: the rules themselves; sums by hand between them.
  const auto damping = [](double z, double d) {
    return demand("fuzzy", {.body_velocity = z, .deflection_velocity = d}).value;
  };
  CHECK(damping(0.3, 1) == 3900);
  CHECK(damping(-0.3, -1) == 3900);
  CHECK(damping(0.3, -1) == 300);
  CHECK(damping(0, 0) == 300);
  CHECK_CLOSE(damping(0.3, 0), 2100, 1e-12, 0);
  CHECK_CLOSE(damping(0, -0.5), 2100, 1e-12, 0);
  CHECK_CLOSE(damping(0.1, 0.3), 300 + 3600 * (0.375 + 0.5 * (0.125 + 0.375)), 1e-12, 0);
  for (double z = -0.3; z < 0.3; z += 1e-3)
    CHECK(std::abs(damping(z + 1e-3, 0.2) - damping(z, 0.2)) < 3600 * 1e-3 / 0.2);
}

TEST_CASE("sliding mode: the force of its surface, and a body that moves like the model's") {
  // At rest the model does not move: F = m n sat(z' / b), m = 400 kg of this car.
  const StrutSignals s{.body_velocity = 0.05, .deflection = 0, .deflection_velocity = 0.4};
  CHECK_CLOSE(demand("sliding_mode,reaching=2,layer=0.1", s).value, 400 * 2 * 0.5, 1e-12, 0);
  CHECK_CLOSE(demand("sliding_mode,reaching=2,mass=200kg", s).value, 200 * 2 * 0.5, 1e-12, 0);

  // On a wheel at rest a skyhook damper is an ordinary one: once the surface is reached, after half
  // a second, the body moves as m z'' + 300 z' + k z = 0 says.
  const Plant plant = load_plant_set("savaresi_spelta").plant;
  const double mass = 400, stiffness = 20000, dt = 1e-3, decay = 300 / (2 * mass);
  const double w = std::sqrt(stiffness / mass - decay * decay);
  const ControllerPointer law =
      make_controller("sliding_mode,damping=300", {{0, 1e9, 0, 1, dt}, plant});
  std::vector<double> state(law->state_size());
  law->reset(state);
  double z = 0, v = 0.3, z0 = 0, v0 = 0, worst = 0;
  for (int k = 0; k < 3000; ++k) {
    const StrutSignals signals{.body_velocity = v, .deflection = z, .deflection_velocity = v};
    DamperDemand answer;
    law->step(std::span(&signals, 1), {}, state, std::span(&answer, 1));
    if (k == 500) z0 = z, v0 = v;
    const double t = (k - 500) * dt;
    if (t > 0) {
      const double free =
          std::exp(-decay * t) *
          (v0 * std::cos(w * t) - (decay * v0 + stiffness / mass * z0) / w * std::sin(w * t));
      worst = std::max(worst, std::abs(v - free));
    }
    v -= dt * (stiffness * z + answer.value) / mass;
    z += dt * v;
  }

  // The damper's cone cuts the force where the body turns; without damping it would be 0.15.
  CHECK(worst < 0.02);
}

TEST_CASE("linear-quadratic regulator of the one-sensor paper's quarter car: TC-7.10") {
  const Plant plant = load_plant_set("tudon_martinez2012").plant;
  const std::vector<double> k = regulator_of(plant, {.deflection = 1e3, .tyre_deflection = 1e4});
  REQUIRE(k.size() == 4);
  // From [z_s, z_us, z_s', z_us'] to [z_s - z_us, z_s', z_us - z_r, z_us'].
  CHECK_CLOSE(k[0], -25061.985, 1e-7, 0);
  CHECK_CLOSE(k[2], 3062.826, 2e-7, 0);
  CHECK_CLOSE(k[0] + k[1], 2845.9717, 1e-6, 0);
  CHECK_CLOSE(k[3], -858.39385, 1e-7, 0);
}

TEST_CASE("clipped laws stay in the damper's cone; clipped-optimal switches by the force") {
  const Plant plant = load_plant_set("tudon_martinez2012").plant;
  for (const char* law : {"clipped_lqr", "clipped_optimal"}) {
    CHECK(needs_plant_state(law));
    const ControllerPointer controller = make_controller(law, {kLimits, plant});
    const std::vector<double> x{0.01, -0.005, 0.3, -0.2};
    const StrutSignals s{.deflection_velocity = 0.5, .force = 200};
    DamperDemand answer;
    controller->step(std::span(&s, 1), x, {}, std::span(&answer, 1));
    const std::vector<double> k = regulator_of(plant, {});
    const double wanted = k[0] * x[0] + k[1] * x[1] + k[2] * x[2] + k[3] * x[3];
    if (answer.kind == DamperDemand::Kind::Force)
      CHECK_CLOSE(answer.value, std::fmin(std::fmax(wanted, 150), 1950), 1e-12, 0);
    else
      CHECK(answer.value == ((wanted - 200) * 200 > 0 ? 1 : 0));
  }
  CHECK(needs_plant_state("selector(skyhook/clipped_lqr)"));
  CHECK(!needs_plant_state("mix1"));
  // A full car's four dampers are regulated together.
  const Plant car = load_plant_set("ikenaga2000").plant;
  CHECK(regulator_of(car, {.force = 1e-8}).size() == 4 * 14);
  // Four corners of a stiff body: one combination of forces moves wheels only.
  CHECK(message_of([&] { regulator_of(car, {}); }).find("costs nothing") != std::string::npos);
}

TEST_CASE("frequency estimation: TC-7.11 by its sums") {
  // x = 0.01 sin(2 pi 3.7 t), fs = 500, 2 s; the exact derivative gives 3.6636429 over this window.
  double speeds = 0, ways = 0;
  for (int k = 0; k < 1000; ++k) {
    const double w = 2 * std::numbers::pi * 3.7, t = k / 500.0;
    speeds += std::pow(0.01 * w * std::cos(w * t), 2);
    ways += std::pow(0.01 * std::sin(w * t), 2);
  }
  CHECK_CLOSE(std::sqrt(speeds / ways) / (2 * std::numbers::pi), 3.6636429, 1e-7, 0);
  // The controller's forgetting sums settle in the same band: soft at 3.7 Hz, hard at 1 Hz and at
  // 11 Hz.
  const Plant plant = load_plant_set("savaresi_spelta").plant;
  const ControllerPointer feb = make_controller("feb", {kLimits, plant});
  for (const auto& [f, damping] : {std::pair{1.0, 3900.0}, {3.7, 300.0}, {11.0, 3900.0}}) {
    std::vector<double> state(feb->state_size());
    feb->reset(state);
    DamperDemand answer;
    for (int k = 0; k < 3000; ++k) {
      const double w = 2 * std::numbers::pi * f, t = k * 1e-3;
      const StrutSignals s{.deflection = 0.01 * std::sin(w * t),
                           .deflection_velocity = 0.01 * w * std::cos(w * t)};
      feb->step(std::span(&s, 1), {}, state, std::span(&answer, 1));
    }
    CHECK(answer.value == damping);
  }
}

TEST_CASE("every law answers within its limits whatever the signals") {
  const Plant plant = load_plant_set("savaresi_spelta").plant;
  for (const ControlLaw* law : control_laws()) {
    CAPTURE(law->name);
    const ControllerPointer controller = make_controller(std::string(law->name), {kLimits, plant});
    std::vector<double> state(controller->state_size());
    controller->reset(state);
    for (int k = 0; k < 200; ++k) {
      const auto wave = [&](double f) { return std::sin(f * k); };
      const StrutSignals s{wave(0.7),
                           10 * wave(1.3),
                           wave(2.1),
                           0.05 * wave(0.3),
                           wave(0.7) - wave(2.1),
                           900 * wave(1.1),
                           0.5};
      const std::vector<double> x{0.01 * wave(0.2), 0.01 * wave(0.4), s.body_velocity,
                                  s.wheel_velocity};
      DamperDemand d;
      controller->step(std::span(&s, 1), x, state, std::span(&d, 1));
      const double speed = std::abs(s.deflection_velocity);
      if (d.kind == DamperDemand::Kind::Damping) CHECK((d.value >= 300 && d.value <= 3900));
      if (d.kind == DamperDemand::Kind::Force)
        CHECK(d.value * s.deflection_velocity >= 299.999 * speed * speed);
      if (d.kind == DamperDemand::Kind::Current) CHECK((d.value == 0 || d.value == 1));
    }
  }
}

TEST_CASE("a controller that cannot be made is refused, with what would be right") {
  const Plant plant = load_plant_set("savaresi_spelta").plant;
  const auto refusal = [&](const std::string& text, const ControlLimits& limits) {
    return message_of([&] { make_controller(text, {limits, plant}); });
  };
  CHECK(refusal("skyhok", kLimits).find("did you mean 'skyhook'") != std::string::npos);
  CHECK(refusal("mix1,crossover=1kg", kLimits).find("not a unit of it") != std::string::npos);
  CHECK(refusal("mix1,crosover=1", kLimits).find("did you mean 'crossover'") != std::string::npos);
  CHECK(refusal("selector(skyhook)", kLimits).find("two laws") != std::string::npos);
  CHECK(refusal("skyhook", {500, 300, 0, 1, 1e-3}).find("rising") != std::string::npos);
  CHECK(refusal("skyhook", {300, 500, 0, 1, 0}).find("sample time") != std::string::npos);
}
