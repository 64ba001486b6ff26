#include "dashpot/suspension/lanes/batch.h"

#include "fleet.h"

using namespace dashpot;
using namespace fleets;

namespace {

/// The last of a fleet, after two seconds at this tolerance.
BatchResult ridden(const Fleet& fleet, double tolerance) {
  const BatchOptions options{.duration = 2,
                             .relative_tolerance = tolerance,
                             .absolute_tolerance = 1e-3 * tolerance,
                             .traces = true};
  return simulate_batch(fleet.vehicles, options).back();
}

}  // namespace

TEST_CASE("lanes ride as simulate() does: networks, laws, lags, stops, tyres that lift") {
  struct Case {
    std::string name;
    Fleet fleet;
    double tolerance;
  };
  const std::vector<double> bingham{900, 300, 10, 0.05};
  Case cases[] = {
      {"2-10-1", {network_damper({2, 10, 1}, {"velocity", "current"}), "mix1", 2}, 1e-5},
      {"3-5-4-1 and a lag",
       {network_damper({3, 5, 4, 1}, {"displacement", "velocity", "current"}, 200), "sh_add", 2},
       1e-5},
      {"1-7-1", {network_damper({1, 7, 1}, {"velocity"}), nullptr, 2}, 1e-5},
      {"bingham", {law_damper("bingham", bingham), nullptr, 2}, 1e-5},
      {"more forces",
       {law_damper("bingham", bingham, 100),
        "clipped_lqr",
        2,
        {{"tyres_may_lift", 1},
         {"friction", 30},
         {"extension_stop", 0.01},
         {"compression_stop", 0.02},
         {"stop_stiffness", 2e5}}},
       1e-4},
      {"bouc_wen",
       {law_damper("bouc_wen", {8800, 900, 100, 0, 1e5, 1e5, 120, 2, 0}), nullptr, 2},
       1e-4}};
  for (const Case& c : cases) {
    CAPTURE(c.name);
    const BatchVehicle& vehicle = c.fleet.vehicles[1];
    CAPTURE(reason_against_lanes(vehicle));
    const BatchResult result = simulate_batch(
        c.fleet.vehicles, {.duration = 2, .relative_tolerance = 1e-7, .traces = true})[1];
    REQUIRE(result.in_lanes);
    const Trace trace = simulate(
        vehicle.setting, {.duration = 2, .relative_tolerance = 1e-7, .limits = vehicle.limits});
    for (const char* channel :
         {"body", "wheel", "suspension_deflection", "tyre_load", "suspension_current"})
      CHECK(apart(result.trace, trace.record, channel) < c.tolerance);
  }
}

TEST_CASE("control laws of two states command in lanes what they command of simulate()") {
  for (const char* law : {"add", "groundhook", "mix1,crossover=2.5Hz", "sh_add", "skyhook"}) {
    CAPTURE(law);
    Fleet fleet(network_damper({2, 10, 1}, {"velocity", "current"}), nullptr, 3);
    const ControlLimits own{.damping_min = 800, .damping_max = 3000};  // of the law, not the way
    fleet.controller = make_controller(law, {own, fleet.plants[0]});
    for (BatchVehicle& vehicle : fleet.vehicles)
      vehicle.setting.controller = fleet.controller.get();
    const BatchOptions options{.duration = 1, .relative_tolerance = 1e-8, .traces = true};
    const BatchVehicle& last = fleet.vehicles[2];
    const Record lanes = simulate_batch(fleet.vehicles, options)[2].trace;
    const Trace trace =
        simulate(last.setting, {.duration = 1, .relative_tolerance = 1e-8, .limits = last.limits});
    CHECK(apart(lanes, trace.record, "suspension_current") < 1e-12);
    CHECK(apart(lanes, trace.record, "body") < 1e-6);

    // Both states were commanded.
    const std::vector<double>& current = lanes.channel("suspension_current").samples;
    CHECK(*std::ranges::min_element(current) < *std::ranges::max_element(current));
    CHECK(*std::ranges::min_element(current) > 0.1);
  }
}

TEST_CASE("a network of velocity keeps the tolerance in lanes, in single precision, too") {
  // By a series in time; the same in double precision at 1e-10 is what it is compared with.
  for (const std::size_t neurons : {7, 10})
    for (const std::size_t count : {1, 3}) {
      CAPTURE(neurons);
      CAPTURE(count);
      const Fleet fleet(network_damper({2, neurons, 1}, {"current", "velocity"}), nullptr, count);
      const BatchResult coarse = ridden(fleet, 1e-6), fine = ridden(fleet, 1e-10);
      for (const char* channel :
           {"body", "wheel", "body_velocity", "wheel_velocity", "suspension_force"}) {
        CHECK(apart(coarse.trace, fine.trace, channel) < 1e-6);
        CHECK(apart(coarse.trace, fine.trace, channel) > 0);
      }
      CHECK(!coarse.missed_tolerance);
      CHECK(coarse.evaluations < fine.evaluations);
    }
}

TEST_CASE("stiff hysteresis loops of any shape keep the tolerance in lanes, in few steps") {
  // gamma, beta, n: sharp and blunt knees, loops that leave a saturation faster or slower.
  const double shapes[][3] = {{3.63e6, 3.63e6, 2}, {7e6, 1e6, 2},     {7e6, 0, 2},
                              {1e6, 6e6, 2},       {5e4, 5e4, 1},     {3e5, 2e5, 1.5},
                              {5e8, 5e8, 3},       {8e6, -0.5e6, 2.0}};
  for (const auto& [gamma, beta, n] : shapes) {
    CAPTURE(gamma);
    CAPTURE(beta);
    CAPTURE(n);
    const Fleet fleets[] = {
        {law_damper("modified_bouc_wen", {84000, 2000, 30000, 4690, 500, 0, gamma, beta, 301, n, 0},
                    150),
         "mix1", 3},
        {law_damper("bouc_wen", {88000, 1500, 2500, 0, gamma, beta, 301, n, 0}), nullptr, 3}};
    for (const Fleet& fleet : fleets) {
      const BatchResult coarse = ridden(fleet, 1e-6), fine = ridden(fleet, 1e-9);
      const BatchVehicle& last = fleet.vehicles.back();
      const Trace trace = simulate(last.setting, {.duration = 2,
                                                  .relative_tolerance = 1e-8,
                                                  .absolute_tolerance = 1e-11,
                                                  .limits = last.limits});
      for (const char* channel : {"body", "wheel", "body_velocity", "wheel_velocity"}) {
        CHECK(apart(coarse.trace, fine.trace, channel) < 2e-6);
        CHECK(apart(fine.trace, trace.record, channel) < 1e-6);
      }
      CHECK(!coarse.missed_tolerance);
      CHECK(coarse.evaluations < 2 * 2000);
    }
  }
}

TEST_CASE("a network whose neurons are far from 0 at rest rides in lanes as it does alone") {
  Fleet fleet(network_damper({2, 10, 1}, {"velocity", "current"}), "mix1", 2);
  const auto& network = dynamic_cast<const NetworkModel&>(*fleet.dampers[0].model);
  Mlp mlp = network.members()[0];
  for (std::size_t n = 0; n < 10; ++n) mlp.parameters[20 + n] = n % 2 ? 45.0 : -45.0;
  for (std::size_t n = 0; n < 10; ++n) mlp.parameters[2 * n] = 300;  // the speed brings them back
  fleet.dampers[0].model =
      std::make_shared<NetworkModel>("far", network.inputs(), std::vector{mlp}, 5);
  const BatchVehicle& vehicle = fleet.vehicles[1];
  const BatchOptions options{.duration = 1, .relative_tolerance = 1e-7, .traces = true};
  const BatchResult result = simulate_batch(fleet.vehicles, options)[1];
  REQUIRE(result.in_lanes);
  const Trace trace = simulate(
      vehicle.setting, {.duration = 1, .relative_tolerance = 1e-7, .limits = vehicle.limits});
  for (const char* channel : {"body", "wheel"})
    CHECK(apart(result.trace, trace.record, channel) < 1e-5);
}

TEST_CASE("measures in lanes are those of the trace by simulate()") {
  const Fleet fleet(network_damper({2, 10, 1}, {"velocity", "current"}), "skyhook", 3);
  const BatchOptions options{.duration = 3, .discard = 1};
  const BatchMeasures lanes = simulate_batch(fleet.vehicles, options)[2].measures;
  Fleet twins(network_damper({2, 10, 1}, {"velocity", "current"}), "skyhook", 3);
  twins.dampers[0].model = twins_of(twins.dampers[0]);
  const BatchResult alone = simulate_batch(twins.vehicles, options)[2];
  REQUIRE(!alone.in_lanes);
  CHECK(reason_against_lanes(twins.vehicles[2]) == "its network is one of several");
  CHECK_CLOSE(lanes.body_acceleration, alone.measures.body_acceleration, 1e-5, 0);
  CHECK_CLOSE(lanes.weighted_acceleration, alone.measures.weighted_acceleration, 1e-5, 0);
  CHECK_CLOSE(lanes.tyre_load, alone.measures.tyre_load, 1e-5, 0);
  CHECK_CLOSE(lanes.tyre_deflection, alone.measures.tyre_deflection, 1e-5, 0);
  CHECK_CLOSE(lanes.deflection, alone.measures.deflection, 1e-5, 0);
  CHECK_CLOSE(lanes.greatest_deflection, alone.measures.greatest_deflection, 1e-5, 0);
  CHECK_CLOSE(lanes.energy, alone.measures.energy, 1e-5, 0);
  CHECK_CLOSE(lanes.current, alone.measures.current, 1e-5, 0);
}

TEST_CASE("a tyre that has lifted has no load in lanes") {
  Fleet fleet(law_damper("bingham", {900, 300, 10, 0.05}), nullptr, 2, {{"tyres_may_lift", 1}});
  for (Plant& plant : fleet.plants) plant.tyres[0].static_load *= 0.2;
  const BatchResult result = simulate_batch(fleet.vehicles, {.duration = 2, .traces = true})[1];
  REQUIRE(result.in_lanes);
  const Trace trace = simulate(fleet.vehicles[1].setting, {.duration = 2});
  const std::vector<double>& load = result.trace.channel("tyre_load").samples;
  CHECK(*std::ranges::min_element(load) == 0);
  CHECK(result.measures.contact_lost > 0.02);
  CHECK_CLOSE(result.measures.contact_lost, trace.contact_lost, 0, 1e-3);
}

TEST_CASE("a result depends neither on the number of threads nor on what else is in the batch") {
  const Fleet networks(network_damper({2, 10, 1}, {"velocity", "current"}), "mix1", 19),
      laws(spencer_damper(), "mix1", 7);
  std::vector<BatchVehicle> mixed;
  for (std::size_t k = 0; k < 19; ++k) {
    mixed.push_back(networks.vehicles[18 - k]);
    if (k < 7) mixed.push_back(laws.vehicles[k]);
  }
  const BatchOptions one{.duration = 1, .threads = 1}, many{.duration = 1, .threads = 3};
  const auto alone = simulate_batch(networks.vehicles, one),
             threads = simulate_batch(networks.vehicles, many), among = simulate_batch(mixed, many),
             law = simulate_batch(laws.vehicles, one);
  for (std::size_t k = 0; k < 19; ++k) {
    check_same(alone[k], threads[k]);
    check_same(alone[k], among[k == 18 ? 0 : 18 - k + std::min<std::size_t>(18 - k, 7)]);
  }
  for (std::size_t k = 0; k < 7; ++k) check_same(law[k], among[2 * k + 1]);
}

TEST_CASE("what has no lanes goes one by one, and a lane that diverges does so alone") {
  Fleet fleet(network_damper({2, 10, 1}, {"velocity", "current"}), nullptr, 3);
  fleet.plants[1].struts[0].track = 0;
  const auto results = simulate_batch(fleet.vehicles, {.duration = 0.5});
  CHECK(results[0].in_lanes);
  CHECK(!results[1].in_lanes);
  CHECK(reason_against_lanes(fleet.vehicles[1]) ==
        "a strut of the plant stands on the moving ground");

  Fleet runaway(law_damper("bingham", {900, 0, 0, 1}), nullptr, 4);
  const auto sound = simulate_batch(runaway.vehicles, {.duration = 1});
  runaway.plants[2].damping = {-1e6, 0, 0, -1e6};
  const auto one_lost = simulate_batch(runaway.vehicles, {.duration = 1});
  CHECK(one_lost[2].diverged_at);
  CHECK(std::isfinite(one_lost[2].measures.body_acceleration));
  for (const std::size_t k : {0, 1, 3}) check_same(sound[k], one_lost[k]);
  CHECK(message_of([&] {
          simulate_batch(runaway.vehicles, {.duration = 1, .discard = 1});
        }).find("left out of the measures") != std::string::npos);
}
