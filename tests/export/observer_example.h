#pragma once
#include <memory>
#include <string>

#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/observe.h"

/// The observer of a car on a road that nothing measures, with a published damper in it, at 1 kHz.
struct ExampleObserver {
  dashpot::PlantObserver observer;
  dashpot::ObserverNames names;
};

inline ExampleObserver example_observer(const std::string& damper) {
  using namespace dashpot;
  const ParameterSet set = load_parameter_set(damper);
  const InPlantSetup setup = parse_in_plant_setup(
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
      "  - {channel: level, quantity: deflection, noise: 0.2 mm}\n" +
          std::string(set.model.drive_unit() == DriveUnit::Volt ? "voltage" : "current") +
          ": coil\n",
      "car.yaml");
  ObserveOptions options;
  options.force = {{30, 0.01}, {20, 0.5}};
  const auto model = std::make_shared<LawModel>(set.model);
  return {make_observer(model, usual_domain(set.drive_min, set.drive_max), setup, 1e-3, options),
          observer_names(setup, *model)};
}
