#include "dashpot/machine/plant_advice.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/virtual_campaign.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A mass on a spring with a Bingham damper, pushed at random; its displacement is measured and,
/// where asked for, its acceleration.
InPlantSetup pushed_setup(bool accelerometer, const std::string& parameters) {
  return parse_in_plant_setup(
      "plant: oscillator\nparameters: " + parameters +
          "\ninputs: [{channel: push, kind: force, at: mass}]\nsensors:\n"
          "  - {channel: x, quantity: displacement, at: mass, noise: 0.1 mm}\n" +
          (accelerometer ? "  - {channel: a, quantity: acceleration, at: mass, noise: 0.05}\n"
                         : "") +
          "start: rest\nheld_back: 0\n",
      "pushed.yaml");
}

PlantRecording pushed_recording() {
  InPlantSetup setup = pushed_setup(true, "{mass: 10 kg, damping: 0, stiffness: 4000 N/m}");
  const Law& law = find_law("tanh_kwok");
  std::vector<double> p(law.params.size());
  p[law.index_of("c")] = 60;
  p[law.index_of("alpha")] = 10;
  p[law.index_of("beta")] = 20;
  const VirtualRide ride =
      virtual_campaign(setup, LawModel::constant(law, p),
                       {.duration = 8, .sample_rate = 200, .levels = {0}, .push = 40, .seed = 4})
          .front();
  return {.name = "pushed",
          .sample_time = ride.recorded.sample_time,
          .samples = ride.recorded.size(),
          .channels = ride.recorded.channels};
}

InPlantReport fitted(const InPlantSetup& setup, const std::vector<std::string>& profiles) {
  InPlantOptions options{.starts = 4, .profiles = profiles};
  for (const char* name : {"k", "delta"})
    options.choices.push_back({.law = {}, .parameter = name, .fixed = 0.0});
  return identify_in_plant(find_law("tanh_kwok"), setup, {pushed_recording()}, options);
}

double width_of(const std::vector<FittedParameter>& list, const std::string& name) {
  for (const FittedParameter& p : list)
    if (p.name == name) return p.high - p.low;
  return NAN;
}

const char* const kMassUnknown =
    "{mass: {about: 9 kg, from: 5 kg, to: 20 kg}, damping: 0, stiffness: 4000 N/m}";

}  // namespace

TEST_CASE("advice: the intervals with one more sensor, as the fit with it has them" *
          doctest::test_suite("long")) {
  const InPlantReport without = fitted(pushed_setup(false, kMassUnknown), {});
  const InPlantReport with = fitted(pushed_setup(true, kMassUnknown), {});
  CHECK(without.advice.grade == "car");
  const auto& sensors = without.advice.sensors;
  const auto acceleration =
      std::ranges::find(sensors, "acceleration of mass", &PlantAddition::what);
  REQUIRE(acceleration != sensors.end());

  // Mean over the numbers, and each sensor narrower than nothing; the best one first.
  double product = width_of(with.plant, "mass") / width_of(without.plant, "mass"), count = 1;
  for (const char* name : {"c", "alpha", "beta"}) {
    product *= width_of(with.damper, name) / width_of(without.damper, name);
    count += 1;
  }
  CHECK_CLOSE(acceleration->intervals, std::pow(product, 1 / count), 0.25, 0);
  CHECK(std::ranges::is_sorted(sensors, {}, &PlantAddition::intervals));
  for (const PlantAddition& one : sensors) {
    CHECK(one.intervals <= 1);
    CHECK(one.of_most <= one.intervals * (1 + 1e-9));
  }

  // What is there is not advised. More motion tells more than the same once again.
  CHECK(std::ranges::find(sensors, "displacement of mass", &PlantAddition::what) == sensors.end());
  const auto twice =
      std::ranges::find(without.advice.rides, "twice the amplitude", &PlantAddition::what);
  REQUIRE(twice != without.advice.rides.end());
  CHECK(twice->intervals < 0.8);
}

TEST_CASE("profile: as wide as the local interval where that is right, open where nothing tells") {
  const InPlantReport report = fitted(pushed_setup(false, kMassUnknown), {"mass"});
  REQUIRE(report.advice.profiles.size() == 1);
  const ParameterProfile& mass = report.advice.profiles[0];
  CHECK(mass.name == "mass");
  CHECK_CLOSE(mass.high - mass.low, width_of(report.plant, "mass"), 0.2, 0);
  CHECK(std::ranges::is_sorted(mass.value));
  CHECK(std::ranges::all_of(mass.misfit, [](double m) { return m > -0.05; }));

  // The plant's own dashpot and the law's do the same: neither is known by itself.
  const InPlantReport traded =
      fitted(pushed_setup(false,
                          "{mass: 10 kg, damping: {about: 20, from: 0, to: 500}, "
                          "stiffness: 4000 N/m}"),
             {});
  const auto dashpot =
      std::ranges::find(traded.advice.profiles, "damping", &ParameterProfile::name);
  REQUIRE(dashpot != traded.advice.profiles.end());
  CHECK(std::ranges::all_of(dashpot->misfit, [](double m) { return m < 1; }));
  CHECK_FALSE(std::isfinite(dashpot->high));
  CHECK(contains(message_of([] { fitted(pushed_setup(false, kMassUnknown), {"mas"}); }),
                 "profile: 'mas' is no number that is fitted by itself; did you mean 'mass'"));
}
