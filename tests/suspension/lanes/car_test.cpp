// Vehicles of several struts and tyres in lanes.
#include "dashpot/suspension/lanes/batch.h"
#include "fleet.h"

using namespace dashpot;
using namespace fleets;

namespace {

MountedDamper bingham(double lag_rate = 0) {
  return law_damper("bingham", {900, 300, 10, 0.05}, lag_rate);
}

/// Two lags on the way to the current: the driver's and the model's.
MountedDamper spencer_behind_a_driver() {
  MountedDamper damper = spencer_damper();
  damper.driver.lag_rate = 60;
  return damper;
}

/// Stops that are met and friction in all struts, which half and full cars have no parameters of.
void add_stops(Fleet& fleet) {
  for (Plant& plant : fleet.plants)
    for (Strut& strut : plant.struts) {
      strut.friction = 30;
      strut.extension_stop = 0.01;
      strut.compression_stop = 0.02;
      strut.stop_stiffness = 2e5;
    }
}

}  // namespace

TEST_CASE("half and full cars ride in lanes as simulate() does") {
  for (const Make& make : {kHalf, kFull}) {
    struct Case {
      std::string name;
      Fleet fleet;
      double tolerance;
    };
    Case cases[] = {
        {"network, a control law in lanes",
         {make, network_damper({2, 10, 1}, {"velocity", "current"}), "mix1", 2},
         1e-6},
        {"network of three layers, a lag",
         {make, network_damper({3, 5, 4, 1}, {"displacement", "velocity", "current"}, 200),
          "skyhook", 2},
         1e-6},
        {"law, a regulator of the plant's state",
         {make, bingham(100), "clipped_lqr,force=1e-6", 2},
         1e-5},
        {"stops, friction, tyres that lift, a controller without lanes",
         {make, bingham(100), "hybrid", 2, {{"tyres_may_lift", 1}}},
         1e-4},
        {"one loop per strut",
         {make, law_damper("bouc_wen", {8800, 900, 100, 0, 1e5, 1e5, 120, 2, 0}), nullptr, 2},
         1e-5},
        {"two states per strut and a model's lag", {make, spencer_damper(), "sh_add", 2}, 1e-5},
        {"two lags", {make, spencer_behind_a_driver(), "groundhook", 2}, 1e-5}};
    add_stops(cases[3].fleet);
    for (const Case& c : cases) {
      CAPTURE(make.set);
      CAPTURE(c.name);
      const BatchVehicle& vehicle = c.fleet.vehicles[1];
      const BatchOptions options{.duration = 2, .relative_tolerance = 1e-7, .traces = true};
      CAPTURE(reason_against_lanes(vehicle));
      const BatchResult result = simulate_batch(c.fleet.vehicles, options)[1];
      REQUIRE(result.in_lanes);
      const Trace trace = simulate(
          vehicle.setting, {.duration = 2, .relative_tolerance = 1e-7, .limits = vehicle.limits});

      for (const Coordinate& coordinate : vehicle.setting.plant.coordinates) {
        CHECK(apart(result.trace, trace.record, coordinate.name) < c.tolerance);
        CHECK(apart(result.trace, trace.record, coordinate.name + "_velocity") < c.tolerance);
      }
      for (const Strut& strut : vehicle.setting.plant.struts) {
        CHECK(apart(result.trace, trace.record, strut.name + "_deflection") < c.tolerance);
        CHECK(apart(result.trace, trace.record, strut.name + "_current") < 10 * c.tolerance);
      }
      for (const Tyre& tyre : vehicle.setting.plant.tyres)
        CHECK(apart(result.trace, trace.record, tyre.name + "_load") < c.tolerance);
    }
  }
}

TEST_CASE("a half car whose ends do not move each other rides as two quarter cars") {
  // So it is where its inertia is m a b: a blow at one axle turns it around the other.
  constexpr double kMass = 690, kFront = 1.3, kRear = 1.5, kLength = kFront + kRear;
  const MountedDamper kinds[] = {network_damper({2, 10, 1}, {"velocity", "current"}), bingham(100),
                                 spencer_damper()};
  for (const MountedDamper& damper : kinds) {
    const ControlLimits limits{.current_max = damper.driver.current_max};
    const GroundPointer road =
        make_ground("iso8608,class=C,length=100,wave_number_max=1,waves=100", 4);
    const Plant half = load_plant_set("half_car_a", {{"inertia", kMass * kFront * kRear}}).plant;
    const Plant front = load_plant_set("quarter_car", {{"sprung_mass", kMass * kRear / kLength},
                                                       {"unsprung_mass", 40},
                                                       {"spring_stiffness", 17000},
                                                       {"tyre_stiffness", 200000}})
                            .plant;
    Plant rear = load_plant_set("quarter_car", {{"sprung_mass", kMass * kFront / kLength},
                                                {"unsprung_mass", 45},
                                                {"spring_stiffness", 22000},
                                                {"tyre_stiffness", 200000}})
                     .plant;
    rear.tyres[0].behind = kLength;

    const ControllerPointer mix1 = make_controller("mix1,crossover=2.5Hz", {limits, front});
    const std::vector<MountedDamper> one{damper}, two{damper, damper};
    const std::vector<BatchVehicle> vehicles{{{half, two, *road, mix1.get()}, limits, {}},
                                             {{front, one, *road, mix1.get()}, limits, {}},
                                             {{rear, one, *road, mix1.get()}, limits, {}}};
    const std::vector<BatchResult> rides =
        simulate_batch(vehicles, {.duration = 2, .relative_tolerance = 1e-8, .traces = true});
    const Record &car = rides[0].trace, &at_front = rides[1].trace, &at_rear = rides[2].trace;
    for (const BatchResult& ride : rides) REQUIRE(ride.in_lanes);
    CHECK(apart(car, "front_wheel", at_front, "wheel") < 1e-6);
    CHECK(apart(car, "rear_wheel", at_rear, "wheel") < 1e-6);
    CHECK(apart(car, "front_deflection", at_front, "suspension_deflection") < 1e-6);
    CHECK(apart(car, "rear_deflection", at_rear, "suspension_deflection") < 1e-6);
    CHECK(apart(car, "rear_current", at_rear, "suspension_current") < 1e-6);
    CHECK(apart(car, "front_tyre_load", at_front, "tyre_load") < 1e-6);

    // Of two struts and tyres the worst one counts; energies add up.
    const BatchMeasures &whole = rides[0].measures, &f = rides[1].measures, &r = rides[2].measures;
    CHECK_CLOSE(whole.deflection, std::max(f.deflection, r.deflection), 1e-6, 0);
    CHECK_CLOSE(whole.greatest_deflection, std::max(f.greatest_deflection, r.greatest_deflection),
                1e-6, 0);
    CHECK_CLOSE(whole.tyre_load, std::max(f.tyre_load, r.tyre_load), 1e-6, 0);
    CHECK_CLOSE(whole.tyre_deflection, std::max(f.tyre_deflection, r.tyre_deflection), 1e-6, 0);
    CHECK_CLOSE(whole.energy, f.energy + r.energy, 1e-6, 0);
    CHECK_CLOSE(whole.current, 0.5 * (f.current + r.current), 1e-6, 0);
    CHECK(f.deflection != r.deflection);
  }
}

TEST_CASE("measures of half and full cars in lanes are those of the trace by simulate()") {
  for (const Make& make : {kHalf, kFull}) {
    CAPTURE(make.set);
    const NamedValues lift{{"tyres_may_lift", 1}};
    Fleet fleet(make, network_damper({2, 10, 1}, {"velocity", "current"}), "skyhook", 3, lift),
        twins(make, network_damper({2, 10, 1}, {"velocity", "current"}), "skyhook", 3, lift);
    for (MountedDamper& damper : twins.dampers) damper.model = twins_of(damper);
    for (Fleet* each : {&fleet, &twins})
      for (Plant& plant : each->plants)
        for (Tyre& tyre : plant.tyres) tyre.static_load *= 0.4;  // so that it lifts now and then

    // Both meet a tolerance by other steps, and where tyres lift they part by ten times as much: at
    // 1e-6 by 1.6e-5. What is compared are the measures.
    const BatchOptions options{.duration = 3, .discard = 1, .relative_tolerance = 1e-7};
    const BatchResult in_lanes = simulate_batch(fleet.vehicles, options)[2],
                      one_by_one = simulate_batch(twins.vehicles, options)[2];
    REQUIRE(in_lanes.in_lanes);
    REQUIRE(!one_by_one.in_lanes);
    const BatchMeasures &lanes = in_lanes.measures, &alone = one_by_one.measures;
    CHECK_CLOSE(lanes.body_acceleration, alone.body_acceleration, 1e-5, 0);
    CHECK_CLOSE(lanes.weighted_acceleration, alone.weighted_acceleration, 1e-5, 0);
    CHECK_CLOSE(lanes.vibration_dose, alone.vibration_dose, 1e-5, 0);
    CHECK_CLOSE(lanes.tyre_load, alone.tyre_load, 1e-5, 0);
    CHECK_CLOSE(lanes.tyre_deflection, alone.tyre_deflection, 1e-5, 0);
    CHECK_CLOSE(lanes.deflection, alone.deflection, 1e-5, 0);
    CHECK_CLOSE(lanes.greatest_deflection, alone.greatest_deflection, 1e-5, 0);
    CHECK_CLOSE(lanes.energy, alone.energy, 1e-5, 0);
    CHECK_CLOSE(lanes.current, alone.current, 1e-5, 0);
    CHECK_CLOSE(lanes.contact_lost, alone.contact_lost, 0, 2e-3);
    CHECK(lanes.contact_lost > 0.01);
  }
}

TEST_CASE("a half or full car's result depends neither on threads nor on what else rides") {
  const Fleet half(kHalf, network_damper({2, 10, 1}, {"velocity", "current"}), "mix1", 11),
      full(kFull, spencer_damper(), "hybrid", 5),
      quarter(network_damper({2, 10, 1}, {"velocity", "current"}), "mix1", 9);
  std::vector<BatchVehicle> mixed;
  for (std::size_t k = 0; k < 11; ++k) {
    if (k < 5) mixed.push_back(full.vehicles[4 - k]);
    mixed.push_back(half.vehicles[10 - k]);
    if (k < 9) mixed.push_back(quarter.vehicles[k]);
  }
  const BatchOptions one{.duration = 1, .threads = 1}, many{.duration = 1, .threads = 3};
  const auto halves = simulate_batch(half.vehicles, one),
             fulls = simulate_batch(full.vehicles, many),
             quarters = simulate_batch(quarter.vehicles, one), among = simulate_batch(mixed, many),
             again = simulate_batch(mixed, one);
  std::size_t place = 0;
  for (std::size_t k = 0; k < 11; ++k) {
    if (k < 5) check_same(fulls[4 - k], among[place++]);
    check_same(halves[10 - k], among[place++]);
    if (k < 9) check_same(quarters[k], among[place++]);
  }
  for (std::size_t k = 0; k < mixed.size(); ++k) {
    CHECK(among[k].in_lanes);
    check_same(among[k], again[k]);
  }
}

TEST_CASE("a full car that diverges in its lane does so alone") {
  Fleet fleet(kFull, bingham(), "skyhook", 4);
  const auto sound = simulate_batch(fleet.vehicles, {.duration = 1});
  for (std::size_t k = 0; k < 7; ++k) fleet.plants[2].damping[8 * k] = -1e5;
  const auto one_lost = simulate_batch(fleet.vehicles, {.duration = 1, .traces = true});
  REQUIRE(one_lost[2].in_lanes);
  REQUIRE(one_lost[2].diverged_at);
  CHECK(one_lost[2].trace.size() == std::lround(*one_lost[2].diverged_at / 1e-3));
  CHECK(std::isfinite(one_lost[2].measures.body_acceleration));
  for (const std::size_t k : {0, 1, 3}) {
    CHECK(!one_lost[k].diverged_at);
    check_same(sound[k], one_lost[k]);
  }
}

TEST_CASE("vehicles that have no lanes say why") {
  Fleet fleet(kFull, bingham(), nullptr, 1);
  const BatchVehicle& car = fleet.vehicles[0];
  CHECK(reason_against_lanes(car).empty());
  fleet.dampers[3] = network_damper({1, 7, 1}, {"velocity"});
  CHECK(reason_against_lanes(car) == "its dampers are of different kinds");
  fleet.dampers[3] = bingham(100);
  CHECK(reason_against_lanes(car) == "its dampers are of different kinds");
  fleet.dampers[3] = bingham();
  fleet.dampers[3].motion_ratio = 0.7;
  CHECK(reason_against_lanes(car) == "its damper moves otherwise than its strut");
  fleet.dampers[3] = bingham();
  fleet.plants[0].struts.push_back(fleet.plants[0].struts[0]);
  CHECK(reason_against_lanes(car) ==
        "the plant has more coordinates, struts or tyres than a full car");
  fleet.plants[0].tyres.clear();
  CHECK(reason_against_lanes(car) == "the plant is no vehicle on tyres");
}
