#include "dashpot/suspension/ride/ride_measures.h"

#include <algorithm>

#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/ride/simulated_run.h"
#include "dashpot/suspension/trace.h"
#include "support.h"

using namespace dashpot;

namespace {

SimulatedRun run_of(const VehicleWords& words, const std::string& ground, double duration) {
  const auto vehicle = std::make_shared<const Vehicle>(make_vehicle(words));
  return run_vehicle(vehicle, *make_ground(ground, 1), {.duration = duration});
}

double value(const SimulatedRun& run, const char* name) {
  return measure_named(run.measures, name);
}

}  // namespace

TEST_CASE("measures of a step: TC-3.6 and TC-10.2") {
  const SimulatedRun run =
      run_of({.plant = "tudon_martinez2012", .dampers = {"viscous,damping=2280"}}, "step", 6);
  CHECK(run.name == "viscous, 2280 N*s/m");
  CHECK_CLOSE(value(run, "settling"), 0.703, 0, 1e-9);
  CHECK_CLOSE(value(run, "tyre_settling"), 0.360, 0, 1e-9);
  CHECK_CLOSE(value(run, "decay_ratio"), 0.077995, 1e-4, 0);
  CHECK_CLOSE(value(run, "deviation"), 7.284117, 1e-6, 0);
  CHECK_CLOSE(value(run, "tyre_deviation"), 30, 1e-9, 0);
  CHECK_CLOSE(value(run, "body_acceleration"), 0.705644, 2e-4, 0);
  CHECK(std::isnan(value(run, "current")));  // nothing drives it
}

TEST_CASE("what a seat does is told of the seat, not of a tyre") {
  const SimulatedRun run =
      run_of({.plant = "boileau_rakheja1998", .dampers = {"viscous"}}, "iso8608_fft,length=50", 2);
  const auto title = [&](const char* name) {
    return std::ranges::find(run.measures, name, &RideMeasure::name)->title;
  };
  CHECK(title("tyre_load") == "dynamic over static seat load, rms");
  CHECK(title("contact_lost") == "seat without load, of the time");
  REQUIRE(!run.trace.warnings.empty());
  CHECK(run.trace.warnings.front().starts_with("a seat pulls, which none can, in "));
}

TEST_CASE("what has not settled by the end of a run has no time of settling") {
  // Its damper all but locked, the car rings on its tyre for longer than that.
  const SimulatedRun run =
      run_of({.plant = "tudon_martinez2012", .dampers = {"viscous,damping=1e6"}}, "step", 6);
  CHECK(std::isnan(value(run, "settling")));
  CHECK(std::isnan(value(run, "tyre_settling")));
}

TEST_CASE("a steady sine: comfort, tyre load, travel and energy in closed form") {
  const VehicleWords words{.plant = "tudon_martinez2012", .dampers = {"viscous,damping=2280"}};
  const SimulatedRun run = run_of(words, "sine,amplitude=2mm,frequency=5", 25);
  // TC-3.6b at 5 Hz: 334.235181 1/s^2 and 0.708551; |Wk| 1.038826 (TC-10.3).
  const double rms = 334.235181 * 0.002 / std::sqrt(2.0);
  CHECK_CLOSE(value(run, "body_acceleration"), rms, 1e-4, 0);
  CHECK_CLOSE(value(run, "weighted_acceleration"), rms * 1.038826, 2e-3, 0);
  const double load = 295200 * 0.708551 * 0.002 / std::sqrt(2.0) / ((387 + 139.5) * 9.81);
  CHECK_CLOSE(value(run, "tyre_load"), 100 * load, 1e-4, 0);
  CHECK(value(run, "contact_lost") == 0);
  const double speed = value(run, "travel") / 1000 * 2 * std::numbers::pi * 5;  // rms, of the strut
  CHECK_CLOSE(value(run, "damper_energy"), 2280 * speed * speed * 20, 1e-3, 0);
  CHECK_CLOSE(value(run, "damper_force"), 2280 * speed * std::sqrt(2.0), 1e-3, 0);
}

TEST_CASE("the energy that a damper takes is by the trapezoidal rule, of the samples that count") {
  Record trace;
  trace.time = {0, 1, 2, 4};
  trace.channels = {{"strut_force", "N", {9, 2, 2, 2}, ""},
                    {"strut_velocity", "m/s", {9, 1, 2, 3}, ""}};
  Strut strut;
  strut.name = "strut";
  CHECK(damper_energy(trace, strut, 1) == 3 + 10);  // powers 2, 4 and 6 W, 1 s and 2 s apart
}

TEST_CASE("the start counts where the ground is not alike all along") {
  CHECK(usual_discard(*make_ground("iso8608,length=100", 1), 20) == 5);
  CHECK(usual_discard(*make_ground("iso8608,length=100", 1), 10) == 0);
  CHECK(usual_discard(*make_ground("step", 1), 20) == 0);
  CHECK(usual_discard(*make_ground("bump", 1), 20) == 0);
}

TEST_CASE("what to compare with: the nominal damping, half of the current, or as said") {
  CHECK(passive_words({.controller = "mix1"}, "").dampers ==
        std::vector<std::string>{"viscous,damping=1500"});
  const VehicleWords real{.dampers = {"spencer1997"}, .controller = "skyhook"};
  CHECK(passive_words(real, "").current == 1.125);
  CHECK(passive_words(real, "").dampers == real.dampers);
  CHECK(passive_words(real, "current=2").current == 2);
  CHECK(passive_words(real, "suv_front").dampers == std::vector<std::string>{"suv_front"});
  CHECK(passive_words(real, "").controller.empty());
  CHECK(name_of(make_vehicle(passive_words(real, ""))) == "spencer1997 at 1.125 V");
}

TEST_CASE(
    "three-storey benchmark in El Centro: passive rows within 2 %, clipped-optimal row within 15 "
    "%") {
  const auto folder = shared_data("earthquake");
  if (folder.empty()) return;
  const std::string ground =
      "earthquake,file=" + (folder / "el_centro_g.dat").string() + ",unit=g0,time_scale=0.2";
  // TC-8.5b: displacement cm, drift cm, acceleration cm/s^2 of each floor; N. The passive
  // rows as an independent simulation has them with this record; the last one as published by Dyke
  // et al. (recalled), whose LQG sees accelerations: ours feeds back the state, with weights that
  // come near their peaks.
  const char* const optimal =
      "clipped_optimal,deflection=0,tyre_deflection=0,force=0.01,top_acceleration=1000";
  const struct {
    const char* controller;
    double voltage, tolerance, x[3], drift[3], acceleration[3], force;
  } rows[] = {
      {"", 0, 0.02, {0.2113, 0.3581, 0.4547}, {0.211, 0.154, 0.104}, {419.5, 489.6, 725.1}, 259.5},
      {"",
       2.25,
       0.02,
       {0.0788, 0.1953, 0.3057},
       {0.079, 0.157, 0.111},
       {281.8, 499.6, 770.4},
       982.0},
      {optimal, 0, 0.15, {0.114, 0.185, 0.212}, {0.114, 0.090, 0.101}, {696, 739, 703}, 941}};
  for (const auto& row : rows) {
    CAPTURE(row.controller);
    CAPTURE(row.voltage);
    const SimulatedRun run = run_of({.plant = "dyke_spencer1996",
                                     .dampers = {"spencer1997,x0=0"},
                                     .controller = row.controller,
                                     .current = row.voltage},
                                    ground, 8);
    for (int k = 0; k < 3; ++k) {
      const std::string floor = "floor_" + std::to_string(k + 1);
      CHECK_CLOSE(value(run, floor.c_str()), 10 * row.x[k], row.tolerance, 0);
      CHECK_CLOSE(value(run, (floor + "_drift").c_str()), 10 * row.drift[k], row.tolerance, 0);
      CHECK_CLOSE(value(run, (floor + "_acceleration").c_str()), row.acceleration[k] / 100,
                  row.tolerance, 0);
    }
    CHECK_CLOSE(value(run, "damper_force"), row.force, row.tolerance, 0);
  }
}
