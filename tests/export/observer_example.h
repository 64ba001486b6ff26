#pragma once
#include <memory>
#include <string>
#include <vector>

#include "damper/kinds/hysteresis_network/hysteresis_network_example.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/observe.h"

/// The observer of a car on a road that nothing measures, with a published damper in it, at 1 kHz.
struct ExampleObserver {
  dashpot::PlantObserver observer;
  dashpot::ObserverNames names;
};

/// shift: m/s, of the velocity by which the model's force goes.
inline ExampleObserver example_observer_in(const std::string& plant,
                                           std::shared_ptr<const dashpot::DamperModel> model,
                                           const dashpot::Domain& domain, double shift = 0) {
  using namespace dashpot;
  const InPlantSetup setup = parse_in_plant_setup(plant, "car.yaml");
  ObserveOptions options;
  options.force = {{30, 0.01}, {20, 0.5}, {90, kStayingError}};
  options.shift = {shift, 0.015};
  return {make_observer(model, domain, setup, 1e-3, options), observer_names(setup, model->name())};
}

inline ExampleObserver example_observer_in(const std::string& plant, const std::string& damper,
                                           const std::string& drive = "coil", double shift = 0) {
  using namespace dashpot;
  const ParameterSet set = load_parameter_set(damper);
  const bool by_voltage = set.model.drive_unit() == DriveUnit::Volt;
  return example_observer_in(plant + (by_voltage ? "voltage: " : "current: ") + drive + "\n",
                             std::make_shared<LawModel>(set.model),
                             usual_domain(set.drive_min, set.drive_max), shift);
}

inline const std::string kExampleCar =
    "plant: quarter_car\n"
    "parameters:\n"
    "  unsprung_mass: 40 kg\n"
    "  spring_stiffness: 20 N/mm\n"
    "  sprung_mass: 350 kg\n"
    "  tyre_stiffness: 190 N/mm\n"
    "inputs:\n"
    "  - {kind: ground, class: C, speed: 20 m/s}\n"
    "sensors:\n"
    "  - {channel: az_body, quantity: acceleration, at: body, noise: 0.05}\n"
    "  - {channel: az_wheel, quantity: acceleration, at: wheel, noise: 0.5}\n"
    "  - {channel: level, quantity: deflection, noise: 0.2 mm}\n";

inline ExampleObserver example_observer(const std::string& damper, double shift = 0) {
  return example_observer_in(kExampleCar, damper, "coil", shift);
}

/// With a network of more states than a filter estimates.
inline ExampleObserver example_network_observer() {
  using namespace dashpot;
  std::vector<HysteresisNetwork> members;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    members.push_back(example_hysteresis_network(seed));
  const auto model =
      std::make_shared<HysteresisNetworkModel>("hysteresis_network", std::move(members));
  return example_observer_in(kExampleCar + "current: coil\n", model, usual_domain(0, 2));
}

inline const std::string kMeasuredRoads =
    "  - {channel: road_front, kind: ground, at: front, noise: 0.2 mm}\n"
    "  - {channel: road_rear, kind: ground, at: rear, noise: 0.2 mm}\n";
inline const std::string kUnmeasuredRoads =
    "  - {kind: ground, at: front, class: C, speed: 20 m/s}\n"
    "  - {kind: ground, at: rear, class: C, speed: 20 m/s}\n";

/// The same of a half car with this damper in both struts.
inline ExampleObserver example_half_car_observer(const std::string& damper,
                                                 const std::string& drive = "coil",
                                                 double shift = 0,
                                                 const std::string& roads = kMeasuredRoads) {
  return example_observer_in(
      "plant: half_car\n"
      "parameters: {mass: 690 kg, inertia: 1222 kg*m^2, front_wheel_mass: 40 kg,\n"
      "  rear_wheel_mass: 45 kg, front_stiffness: 17 N/mm, rear_stiffness: 22 N/mm,\n"
      "  front_tyre_stiffness: 200 N/mm, rear_tyre_stiffness: 200 N/mm, front_distance: 1.3 m,\n"
      "  rear_distance: 1.5 m}\n"
      "inputs:\n" +
          roads +
          "sensors:\n"
          "  - {channel: az_body, quantity: acceleration, at: body, noise: 0.05}\n"
          "  - {channel: rate, quantity: velocity, at: pitch, noise: 0.3 deg/s}\n"
          "  - {channel: az_rear, quantity: acceleration, at: rear_wheel, noise: 0.5}\n"
          "  - {channel: level, quantity: deflection, at: front, noise: 0.2 mm}\n"
          "  - {channel: cell, quantity: damper_force, at: rear, noise: 20 N}\n",
      damper, drive, shift);
}
