#include "dashpot/vehicle.h"

#include <numbers>

#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/model_file.h"
#include "dashpot/numerics/root_mean_square.h"
#include "dashpot/suspension/dampers/damper_state.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/ride/domain_use.h"
#include "dashpot/suspension/ride/ride.h"
#include "support.h"

using namespace dashpot;

namespace {

double force(const ChosenDamper& damper, double velocity, double drive) {
  std::vector<double> state(damper.model->state_size());
  damper.model->rest({0, velocity, drive}, state);
  return damper.model->force({0, velocity, drive}, state);
}

}  // namespace

TEST_CASE("dampers by words") {
  const ChosenDamper viscous = choose_damper("viscous,damping=2 kN*s/m");
  CHECK(viscous.name == "viscous, 2000 N*s/m");
  CHECK(viscous.is_passive());
  CHECK(force(viscous, 0.1, 0) == 200);
  const ChosenDamper ideal =
      choose_damper("ideal, damping_min=500 ,damping_max=2500, motion_ratio=0.5");
  CHECK(ideal.name == "ideal, 500 to 2500 N*s/m, motion ratio 0.5");
  CHECK_CLOSE(force(ideal, 0.1, 0.25), 100, 1e-12, 0);
  CHECK(ideal.motion_ratio == 0.5);
  CHECK_CLOSE(ideal.lag_rate, 2 * std::numbers::pi * 50, 1e-12, 0);
  const ChosenDamper spencer = choose_damper("spencer1997,x0=0");
  CHECK(spencer.drive_unit == DriveUnit::Volt);
  CHECK(spencer.drive_max == 2.25);
  CHECK(spencer.lag_rate == 190);
  CHECK(force(spencer, 0, 0) == 0);  // no accumulator's force
  CHECK(choose_damper("suv_rear").is_passive());
}

TEST_CASE("a plant whose damper has one damping rides on that, unasked") {
  // Of four published sets the range is a point.
  for (const char* name : {"baig", "ctms_bus", "half_car_a", "robust_control_demo"}) {
    CAPTURE(name);
    const Vehicle vehicle = make_vehicle({.plant = name});
    CHECK(vehicle.damper_names.front().starts_with("viscous, "));
  }
  CHECK(make_vehicle({.plant = "ikenaga2000"}).damper_names.front().starts_with("ideal, "));
}

TEST_CASE("friction that jumps is smoothed, with a note; a speed that is stated stays") {
  const TemporaryFolder folder;
  const auto file = [&](double speed) {
    const LawModel model = LawModel::constant(find_law("bingham"), {1000, 100, 0, speed});
    const auto path = folder.path() / ("bingham" + std::to_string(speed) + ".json");
    save_model({.model = model.with_offset(0), .domain = {-1, 1, -1, 1, 0, 1}}, path);
    return choose_damper(path.string());
  };
  const ChosenDamper smooth = file(0), stated = file(0.01);
  CHECK_CLOSE(force(smooth, 0.002, 0), 2 + 100 * std::tanh(1), 1e-9, 0);
  CHECK_CLOSE(force(stated, 0.01, 0), 10 + 100 * std::tanh(1), 1e-9, 0);
  REQUIRE(smooth.notes.size() == 1);
  CHECK(smooth.notes[0] == "the friction of bingham sets in over 2 mm/s here, not at once");
  CHECK(stated.notes.empty());
  CHECK(smooth.drive_max == 1);
}

TEST_CASE("damper words that mean nothing are refused") {
  const auto refusal = [](const char* words) {
    return message_of([&] { choose_damper(words, "--damper"); });
  };
  CHECK(refusal("viscos").find("--damper: unknown damper 'viscos'; did you mean 'viscous'?") == 0);
  CHECK(refusal("viscous,damping=-5").find("--damper: damping is -5 N*s/m; ") == 0);
  CHECK(refusal("ideal,damping_min=4000") ==
        "--damper: damping from 4000 N*s/m to 3900 N*s/m; damping_min below damping_max");
  CHECK(refusal("spencer1997,y0=0").find("--damper: modified_bouc_wen has no parameter 'y0'") == 0);
  CHECK(refusal("suv_front,gain=2") ==
        "--damper: 'gain=2' says nothing to suv_front; motion_ratio=... or force_factor=...");
  CHECK(refusal("missing/model.json").find("missing/model.json") == 0);
}

TEST_CASE(
    "damping that dissipates alike: exact for a linear damper, 4 f / (pi w A) for dry friction") {
  CHECK_CLOSE(equivalent_damping(*choose_damper("viscous,damping=1234").model, 0, 0.02, 0.2), 1234,
              1e-12, 0);
  const LawModel friction = LawModel::constant(find_law("bingham"), {0, 100, 0, 0});
  CHECK_CLOSE(equivalent_damping(friction, 0, 0.01, 0.3), 4 * 100 / (std::numbers::pi * 0.3), 1e-3,
              0);
  const ChosenDamper levered = choose_damper("viscous,damping=1000,motion_ratio=2");
  CHECK(damping_between(levered, 0, 0).nominal == 4000);
}

TEST_CASE("a vehicle by words is the one by hand: the plant's own range, mix1, TC 7.13 at 4 Hz") {
  const Vehicle vehicle = make_vehicle({.controller = "mix1"});
  CHECK(vehicle.limits.damping_min == 300);
  CHECK(vehicle.limits.damping_max == 3900);
  CHECK(vehicle.notes.size() == 1);  // the plant's numbers are recalled
  const GroundPointer sine = make_ground("sine,amplitude=5mm,frequency=4", 1);
  SimulateOptions options = vehicle.options(10);
  options.step = 1e-3;
  const Trace trace = simulate(vehicle.on(*sine), options);
  CHECK_CLOSE(gain_at(trace.record.channel("body_acceleration").samples,
                      trace.record.channel("tyre_road").samples, 1e-3, 4, 16)
                  .fundamental,
              59.8, 0.03, 0);
}

TEST_CASE("a damper on a lever: a viscous one of c at a ratio i is one of c i^2 without") {
  const GroundPointer bump = make_ground("bump", 1);
  const auto ride = [&](const char* damper) {
    const Vehicle vehicle = make_vehicle({.dampers = {damper}});
    return simulate(vehicle.on(*bump), vehicle.options(3)).record.channel("body").samples;
  };
  const std::vector<double> plain = ride("viscous,damping=1000"),
                            levered = ride("viscous,damping=4000,motion_ratio=0.5");
  for (std::size_t k = 0; k < plain.size(); ++k) CHECK_CLOSE(levered[k], plain[k], 1e-9, 1e-12);
}

TEST_CASE(
    "a damper built stronger than its model: its force is, and its controller does not know") {
  const Vehicle drawn = make_vehicle({.dampers = {"spencer1997,x0=0"}, .controller = "skyhook"}),
                built = make_vehicle(
                    {.dampers = {"spencer1997,x0=0,force_factor=1.2"}, .controller = "skyhook"});
  CHECK(built.limits.damping_max == drawn.limits.damping_max);
  CHECK(built.damper_names[0] == "spencer1997, x0=0, force factor 1.2");
  const DamperState a(drawn.dampers[0], drawn.limits, 0), b(built.dampers[0], built.limits, 0);
  CHECK_CLOSE(b.force({0.01, 0.2, 0}), 1.2 * a.force({0.01, 0.2, 0}), 1e-12, 0);
  const GroundPointer bump = make_ground("bump", 1);
  const auto ride = [&](const char* damper) {
    const Vehicle vehicle = make_vehicle({.dampers = {damper}});
    return simulate(vehicle.on(*bump), vehicle.options(3)).record.channel("body").samples;
  };
  const std::vector<double> plain = ride("viscous,damping=1200"),
                            strong = ride("viscous,damping=1000,force_factor=1.2");
  for (std::size_t k = 0; k < plain.size(); ++k) CHECK_CLOSE(strong[k], plain[k], 1e-9, 1e-12);
}

TEST_CASE(
    "a force loop about the inverse finds the force of a damper that is stronger than its model") {
  // v = 0.2 m/s: 60 to 780 N by the model, a quarter more as built.
  const auto force_after = [](const char* loop, std::vector<double> wanted) {
    const Vehicle vehicle =
        make_vehicle({.dampers = {"ideal,damping_min=300,damping_max=3900,force_factor=1.25"},
                      .controller = "skyhook",
                      .inverse = "numeric",
                      .force_loop = loop});
    DamperState damper(vehicle.dampers[0], vehicle.limits, 0);
    DamperInput motion{0, 0.2, 0};
    for (const double newton : wanted)
      for (int k = 0; k < 100; ++k) {
        motion.current = damper.current();
        damper.demand({DamperDemand::Kind::Force, newton}, motion, damper.force(motion));
        damper.advance(motion, motion, 1e-3);
      }
    motion.current = damper.current();
    return damper.force(motion);
  };
  CHECK_CLOSE(force_after("", {400}), 500, 1e-3, 0);
  CHECK_CLOSE(force_after("proportional=0.2,integral=50", {400}), 400, 5e-3, 0);
  // A force out of reach winds nothing up.
  CHECK_CLOSE(force_after("proportional=0.2,integral=50", {5000, 5000, 400}), 400, 5e-3, 0);
  CHECK(message_of([] { make_vehicle({.force_loop = "integral=5"}); }).find("needs an inverse") !=
        std::string::npos);
  CHECK(message_of([] {
          make_vehicle({.inverse = "numeric", .force_loop = "integra=5"});
        }).find("the force loop has no parameter 'integra'") != std::string::npos);
}

TEST_CASE("values in place of the plant's, in its units, and a damper per strut") {
  const Vehicle half = make_vehicle({.plant = "half_car_a", .dampers = {"suv_front", "suv_rear"}});
  CHECK(half.damper_names == std::vector<std::string>{"suv_front", "suv_rear"});
  CHECK(half.notes.size() == 2);  // the dampings at the reference stroke
  const Vehicle heavy =
      make_vehicle({.plant = "tudon_martinez2012", .values = {"sprung_mass=0.5 t"}});
  CHECK(heavy.set.plant.mass[0] == 500);
  const TemporaryFolder folder;
  const auto own =
      folder.write("own.json", R"({"title": "x", "source": "y", "verified": true, "reason": "z",
    "plant": "quarter_car", "parameters": {}, "damping": [100, 900, 2000]})");
  CHECK(make_vehicle({.plant = own.string()}).limits.damping_max == 2000);
}

TEST_CASE("a force is wanted through the inverse of a real damper") {
  const Vehicle vehicle = make_vehicle({.plant = "tudon_martinez2012",
                                        .dampers = {"spencer1997,x0=0"},
                                        .controller = "skyhook_modified",
                                        .inverse = "numeric"});
  CHECK(vehicle.limits.current_max == 2.25);
  CHECK(vehicle.dampers[0].driver.lag_rate == 190);
  CHECK(vehicle.limits.damping_min > 1000);
  CHECK(vehicle.limits.damping_max > 3 * vehicle.limits.damping_min);
  const GroundPointer bump = make_ground("bump", 1);
  const Trace trace = simulate(vehicle.on(*bump), vehicle.options(1.5));
  const std::vector<double>& current = trace.record.channel("suspension_current").samples;
  CHECK(root_mean_square(current) > 0.05);
}

TEST_CASE("vehicles that cannot be are refused, in words") {
  const auto refusal = [](const VehicleWords& words) {
    return message_of([&] { make_vehicle(words); });
  };
  CHECK(refusal({.values = {"sprung_mass=-5"}}) ==
        "vehicle: sprung_mass is -5 kg; between 1 and 1e+06 kg");
  CHECK(refusal({.values = {"mass=5"}}).find("vehicle: quarter_car has no parameter 'mass'") == 0);
  CHECK(refusal({.plant = "quartercar"})
            .find("unknown plant 'quartercar'; did you mean 'quarter_car'?") == 0);
  CHECK(refusal({.controller = "skyhok"})
            .find("vehicle: unknown controller 'skyhok'; did you mean 'skyhook'?") == 0);
  CHECK(refusal({.dampers = {"suv_front"}, .controller = "skyhook"}) ==
        "vehicle: 'skyhook' has nothing to control: every damper is passive; a damper that a "
        "current drives");
  CHECK(refusal({.plant = "dyke_spencer1996"}) ==
        "vehicle: dyke_spencer1996 states no damper of its own; name one");
  CHECK(refusal({.plant = "half_car_a", .dampers = {"suv_front", "suv_rear", "suv_rear"}}) ==
        "vehicle: 3 dampers for the 2 struts of half_car_a; one for all, or one for each");
  CHECK(refusal({.plant = "half_car_a",
                 .dampers = {"spencer1997", "lai_liao2002"},
                 .controller = "skyhook"})
            .find("are not driven over the same range") != std::string::npos);
  CHECK(refusal({.current = 7}) == "vehicle: a drive of 7 is beyond the greatest, 1");
  VehicleWords words{.plant = "tudon_martinez2012", .controller = "clipped_lqr"};
  words.sensors.in_car = true;
  CHECK(refusal(words).find("'clipped_lqr' feeds back what no sensor of a car measures") !=
        std::string::npos);
  VehicleWords late{.controller = "skyhook"};
  late.sensors.delay = 0.005;
  CHECK(refusal(late) ==
        "vehicle: a delay of the sensors, but ideal sensors, which have none; sensors as in a car "
        "(in_car), or no delay");
  CHECK(refusal({.controller = "skyhook,crossover=2Hz"}) ==
        "vehicle: skyhook has no parameter 'crossover'; it has none at all");
  CHECK(refusal({.dampers = {"ideal,lag_rate=50Hz"}}).find("'Hz' is not a unit of a rate") !=
        std::string::npos);
}

TEST_CASE("a damper that is used where it has no data causes a warning") {
  Vehicle vehicle = make_vehicle({.dampers = {"viscous"}});
  vehicle.domains[0] = Domain{.velocity_min = -0.1, .velocity_max = 0.1};
  const GroundPointer sine = make_ground("sine,amplitude=2cm,frequency=1.08", 1);
  const Trace trace = simulate(vehicle.on(*sine), vehicle.options(10));
  const std::vector<DomainUse> uses = domain_use(vehicle, trace);
  REQUIRE(uses.size() == 1);
  CHECK(uses[0].velocity > 0.3);
  CHECK(uses[0].displacement == 0);  // the law does not look at it
  REQUIRE(domain_warnings(uses, 0.05).size() == 1);
  CHECK(domain_warnings(uses, 0.05)[0].find(
            "suspension: viscous, 1500 N*s/m is asked beyond its data: velocity ") == 0);
  CHECK(domain_warnings(uses, 1).empty());
}

TEST_CASE("motions of the ground from files are named like the others") {
  const auto refusal = [](const char* words) {
    return message_of([&] { make_ground(words, 1, "--road"); });
  };
  CHECK(refusal("measured") == "--road: measured names no file; measured,file=...");
  CHECK(refusal("earthquake,path=x").find("--road: earthquake has no parameter 'path'") == 0);
  const auto folder = shared_data("road");
  if (folder.empty()) return;
  const GroundPointer road =
      make_ground("measured,file=" + (folder / "i76_eastbound_left.txt").string() +
                      ",speed=72km/h,distance_unit=ft,height_unit=in",
                  1);
  CHECK_CLOSE(road->duration(), 38, 0.05, 0);
  CHECK(!road->shakes());
  CHECK(make_ground("earthquake,file=" + (shared_data("earthquake") / "el_centro_g.dat").string() +
                        ",unit=g0,time_scale=0.2",
                    1)
            ->shakes());
}

TEST_CASE("a vehicle starts in equilibrium with its dampers' force at rest") {
  // The law has its offset, the published damper its accumulator, the network what it learnt.
  const TemporaryFolder folder;
  const auto path = folder.path() / "gas.json";
  const LawModel gas = LawModel::constant(find_law("bingham"), {1000, 0, -220, 0.01});
  save_model({.model = gas.with_offset(0), .domain = {-1, 1, -1, 1, 0, 1}}, path);
  const GroundPointer step = make_ground("step,height=1 um", 1);
  const auto greatest = [&](const Vehicle& vehicle) {
    const Trace trace = simulate(vehicle.on(*step), vehicle.options(1));
    double most = 0;
    for (const double a : trace.record.channel("body_acceleration").samples)
      most = std::max(most, std::abs(a));
    return most;
  };

  for (const std::string& damper : {path.string(), std::string("spencer1997")}) {
    CAPTURE(damper);
    for (const double current : {0.0, 1.0}) {
      const Vehicle vehicle = make_vehicle({.dampers = {damper}, .current = current});
      CHECK(greatest(vehicle) < 1e-3);
    }
  }

  // It is said, and what was said to be 0 needs no note.
  const auto told = [](const Vehicle& vehicle) {
    for (const std::string& note : vehicle.notes)
      if (contains(note, "is borne by the springs")) return note;
    return std::string();
  };
  CHECK(contains(told(make_vehicle({.dampers = {path.string()}})), "its force at rest, -220 N"));

  // A force at rest that the current changes is told with its current.
  VehicleWords words{.dampers = {"kwok2006"}, .current = 0.75};
  CHECK(contains(told(make_vehicle(words)), "its force at rest at 0.75 A, 43.5 N"));
  CHECK(told(make_vehicle({.dampers = {path.string() + ",f0=0"}})).empty());
  CHECK(told(make_vehicle({.dampers = {"spencer1997,x0=0"}})).empty());
}

TEST_CASE("the parameters of a law in a model file may be set as those of a published damper") {
  const TemporaryFolder folder;
  const auto path = (folder.path() / "law.json").string();
  const LawModel law = LawModel::constant(find_law("bingham"), {1000, 100, 30, 0.01});
  save_model({.model = law.with_offset(0), .domain = {-1, 1, -1, 1, 0, 1}}, path);
  const ChosenDamper set = choose_damper(path + ",c0=2000,f0=0");
  CHECK(set.name == "law.json, c0=2000, f0=0");
  CHECK_CLOSE(force(set, 0.1, 0), 200 + 100 * std::tanh(10), 1e-9, 0);
  CHECK(contains(message_of([&] { choose_damper(path + ",y0=1"); }), "has no parameter 'y0'"));
}
