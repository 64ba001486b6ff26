#include "dashpot/machine/plant_step.h"

#include <cmath>
#include <numbers>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/plant_run.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/vehicle.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Rough road at every instant that a method asks for, sines up to 20 Hz, under a drive that varies
/// by half about its mean.
PlantDriving road(double seconds, double sample_time, std::size_t steps, PlantMethod method,
                  double drive) {
  PlantDriving driving{.sample_time = sample_time,
                       .samples = static_cast<std::size_t>(std::lround(seconds / sample_time)) + 1,
                       .steps = steps,
                       .method = method,
                       .value = {{}},
                       .rate = {{}},
                       .current = {{}}};
  const double step = sample_time / static_cast<double>(driving.stride());
  for (std::size_t k = 0; k < driving.points(); ++k) {
    const double t = step * static_cast<double>(k);
    double value = 0, rate = 0;
    for (int i = 1; i <= 12; ++i) {
      const double turn = 2 * std::numbers::pi * 0.14 * i * i, phase = 1.3 * i * i;
      value += 0.02 / i * std::sin(turn * t + phase);
      rate += 0.02 / i * turn * std::cos(turn * t + phase);
    }
    driving.value[0].push_back(value);
    driving.rate[0].push_back(rate);
  }
  for (std::size_t k = 0; k < driving.points(); ++k)
    driving.current[0].push_back(drive * (1 + 0.5 * std::sin(20 * step * static_cast<double>(k))));
  return driving;
}

std::vector<double> defaults_of(const char* law) {
  std::vector<double> values;
  for (const ParamInfo& row : find_law(law).params) values.push_back(row.value);
  return values;
}

DrivenPlant quarter_car() {
  const PlantInputPlace ground{PlantInput::Ground, 0};
  return {make_plant(find_machine("quarter_car", "test"), {}), {&ground, 1}};
}

/// Body and wheel acceleration and the damper's force; empty where it diverges.
std::vector<std::vector<double>> ride(const DamperModel& damper, const PlantDriving& driving) {
  const DrivenPlant plant = quarter_car();
  const PlantSensorPlace sensors[] = {{PlantQuantity::Acceleration, 0},
                                      {PlantQuantity::Acceleration, 1},
                                      {PlantQuantity::DamperForce, 0}};
  std::vector<double> state(4 + damper.state_size());
  damper.rest({0, 0, driving.current[0].front()}, std::span(state).subspan(4));
  std::vector<std::vector<double>> shown;
  const DamperModel* const dampers[] = {&damper};
  if (!plant.run(dampers, driving, driving.samples, sensors, state, shown)) return {};
  return shown;
}

/// The largest rms difference of a sensor over the rms of what it shows.
double distance(const std::vector<std::vector<double>>& a,
                const std::vector<std::vector<double>>& reference) {
  REQUIRE(a.size() == reference.size());
  double worst = 0;
  for (std::size_t s = 0; s < a.size(); ++s) {
    double change = 0, size = 0;
    for (std::size_t k = 0; k < a[s].size(); ++k) {
      change += std::pow(a[s][k] - reference[s][k], 2);
      size += reference[s][k] * reference[s][k];
    }
    worst = std::max(worst, std::sqrt(change / size));
  }
  return worst;
}

}  // namespace

TEST_CASE("plant step: without a damper the plant is exact under a road that is a cubic") {
  // So that steps of any length agree to rounding.
  const LawModel nothing =
      LawModel::constant(find_law("bouc_wen"), {0, 0, 0, 0, 1e6, 1e6, 1, 2, 0});
  std::vector<std::vector<double>> shown[2];
  for (const std::size_t steps : {1, 10}) {
    PlantDriving driving = road(1, 0.01, steps, PlantMethod::StraightForce, 0);
    for (std::size_t k = 0; k < driving.points(); ++k) {
      const double t = 0.01 / static_cast<double>(steps) * static_cast<double>(k);
      driving.value[0][k] = t * t * (t - 0.4);
      driving.rate[0][k] = t * (3 * t - 0.8);
    }
    shown[steps == 10] = ride(nothing, driving);
  }
  shown[0].pop_back();  // no force
  shown[1].pop_back();
  CHECK(distance(shown[0], shown[1]) < 1e-11);
}

TEST_CASE("plant step: of second order, and agrees with tiny steps of Runge-Kutta") {
  // A law with a step of its own and a coil that lags, one with a travel, one without states.
  const LawModel smooth = LawModel::constant(find_law("tanh_guo"), defaults_of("tanh_guo"));
  for (const LawModel& damper :
       {load_parameters("spencer1997"), load_parameters("spencer1997_bouc_wen"), smooth}) {
    CAPTURE(damper.name());
    const auto reference = ride(damper, road(1, 0.002, 100, PlantMethod::RungeKutta, 1));
    const auto error = [&](std::size_t steps) {
      return distance(ride(damper, road(1, 0.002, steps, PlantMethod::StraightForce, 1)),
                      reference);
    };
    CHECK(error(1) < 0.02);
    CHECK(error(16) < error(1) / 60);  // of first order: a 16th, of second a 256th
  }
}

TEST_CASE("plant step: stable at any stiffness of the damper, where Runge-Kutta is not") {
  const LawModel damper = load_parameters("spencer1997");
  for (const double volt : {0.0, 2.25}) {
    CAPTURE(volt);
    const auto reference = ride(damper, road(4, 0.002, 64, PlantMethod::StraightForce, volt));
    CHECK(ride(damper, road(4, 0.002, 4, PlantMethod::RungeKutta, volt)).empty());
    CHECK(distance(ride(damper, road(4, 0.002, 1, PlantMethod::StraightForce, volt)), reference) <
          0.05);
  }
}

TEST_CASE(
    "plant step: a hysteresis that begins far beyond its loop is on it before the first step") {
  const LawModel damper = load_parameters("spencer1997_bouc_wen");
  std::vector<double> p(damper.law().params.size());
  damper.parameters_at(1, p.data());
  const auto of = [&](const char* name) { return p[damper.law().index_of(name)]; };
  const double z_max = std::pow(of("A") / (of("gamma") + of("beta")), 1 / of("n"));

  // The wheel moves alone, on the way that the hysteresis has gone too far, and nothing but the
  // damper's state changes.
  for (const double wheel : {0.5, -0.5}) {
    std::vector<double> state = {0.01, 0, 0, wheel, (wheel < 0 ? 50 : -50) * z_max};
    state.resize(4 + damper.state_size(), 1.0);
    const DamperModel* const dampers[] = {&damper};
    quarter_car().settle(dampers, road(0.1, 0.002, 1, PlantMethod::StraightForce, 0), state);
    CHECK(std::abs(state[4]) < 1.001 * z_max);
    CHECK(std::abs(state[4]) > 0.9 * z_max);
    CHECK(state[0] == 0.01);
    CHECK(state[3] == wheel);
  }
}

TEST_CASE("plant step: a run beside another one that hardly differs is what it is alone") {
  const DrivenPlant plant = quarter_car();
  const PlantDriving driving = road(2, 0.002, 1, PlantMethod::StraightForce, 1);
  const PlantSensorPlace sensors[] = {{PlantQuantity::Acceleration, 0},
                                      {PlantQuantity::DamperForce, 0}};
  const auto run = [&](const DamperModel& damper, const RunBeside& beside) {
    std::vector<double> state(4 + damper.state_size());
    damper.rest({0, 0, driving.current[0].front()}, std::span(state).subspan(4));
    std::vector<std::vector<double>> shown;
    const DamperModel* const dampers[] = {&damper};
    REQUIRE(plant.run(dampers, driving, driving.samples, sensors, state, shown, beside));
    return shown;
  };
  const LawModel damper = load_parameters("spencer1997");
  RunTangent tangent;
  const auto kept = run(damper, {.keep = &tangent});
  CHECK(tangent.size() == driving.samples - 1);
  CHECK(distance(kept, run(damper, {})) < 1e-6);

  // A millionth off, and so far off that each step must search for itself.
  for (const auto& [share, close] : {std::pair{1e-6, 1e-9}, {0.2, 1e-5}}) {
    CAPTURE(share);
    Dependence stronger = damper.parameters();
    for (double& c : stronger.coefficients[damper.law().index_of("alpha")]) c *= 1 + share;
    const LawModel other(damper.law(), stronger, damper.drive_unit(), damper.lag_rate());
    RunTangent own;
    CHECK(distance(run(other, {.follow = &tangent}), run(other, {.keep = &own})) < close);
  }
}

TEST_CASE("a virtual campaign goes with a damper that is too stiff for Runge-Kutta") {
  // Friction of 400 N that is at its limit after 10 um, or after 0.1 um, and a dashpot.
  const InPlantSetup car = parse_in_plant_setup(
      "plant: quarter_car\n"
      "parameters: {sprung_mass: 350 kg, unsprung_mass: 40 kg, spring_stiffness: 20 N/mm, "
      "tyre_stiffness: 200 N/mm}\n"
      "inputs: [{channel: road, kind: ground}]\n"
      "sensors: [{channel: az, quantity: acceleration, at: body}]\n",
      "car");
  const Law& law = find_law("bouc_wen");
  const auto wheel = [&](double give) {
    std::vector<double> parameters = defaults_of("bouc_wen");
    const std::pair<const char*, double> numbers[] = {
        {"alpha", 400 / give}, {"c0", 500}, {"k0", 0}, {"x0", 0}, {"gamma", 1 / give},
        {"beta", 0},           {"A", 1},    {"n", 1},  {"f0", 0}};
    for (const auto& [name, value] : numbers) parameters[law.index_of(name)] = value;
    const auto rides = virtual_campaign(
        car, LawModel::constant(law, parameters),
        {.duration = 2, .levels = {0}, .road = "iso8608,class=C,speed=20m/s", .seed = 3});
    return rides.front().truth.channel("wheel_velocity").samples;
  };
  const std::vector<double> limit = wheel(1e-5), stiff = wheel(1e-7);
  double square = 0, apart = 0;
  for (std::size_t k = 0; k < limit.size(); ++k) {
    square += limit[k] * limit[k];
    apart += (limit[k] - stiff[k]) * (limit[k] - stiff[k]);
  }
  CHECK(std::sqrt(apart / square) < 0.06);
}
