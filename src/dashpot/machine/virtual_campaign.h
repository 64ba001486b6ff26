#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/monitor.h"
#include "dashpot/record.h"

namespace dashpot {

/// The noise of sensors that state none, by what they show: standard deviations, SI, in the order
/// of PlantQuantity, and of measured inputs in the order of PlantInput. They are assumptions, of
/// the size that data sheets of such sensors state.
struct SensorGrade {
  std::string name;
  double sensors[6], inputs[3];
};
const std::vector<SensorGrade>& sensor_grades();
/// Throws Error that names the known ones.
const SensorGrade& find_sensor_grade(const std::string& name, const std::string& where);

/// The setup with the grade's noise where it states none.
InPlantSetup with_grade(InPlantSetup setup, const SensorGrade& grade);

struct VirtualCampaignOptions {
  double duration = 10;        ///< s, of a ride
  double sample_rate = 500;    ///< Hz
  std::vector<double> levels;  ///< A or V: a ride at each; a second channel is one level ahead
  double hold = 0;   ///< s; above 0: one ride that holds a level so long, then another at random
  std::string road;  ///< as make_ground() has it, under the plants that stand on one
  double push = 0;   ///< rms of a random force, N, or ground acceleration, m/s^2; 0: a usual one
  std::uint64_t seed = 1;
  Monitor monitor;
};

/// What sensors recorded of a plant, and what was true at the same instants: "damper_force", the
/// damper's "suspension_deflection" and "suspension_velocity" (by the name of its place),
/// coordinates and their velocities, and "road"; of several dampers "front_damper_force" and so on,
/// of several roads "front_tyre_road".
struct VirtualRide {
  Record recorded, truth;
};

/// Runs this plant, all of whose numbers are known, with this damper, in equilibrium at rest: the
/// classical Runge-Kutta method, 40 steps per sample. Sensors are behind their filters and late by
/// their delays, have the noise that is stated, and in each ride a zero that is off at random. The
/// same seed gives the same rides. Throws Error where a number is unknown, where the damper's
/// states have no rates, where a ride would have more than 1e7 samples, and where it diverges.
std::vector<VirtualRide> virtual_campaign(const InPlantSetup& setup, const DamperModel& damper,
                                          const VirtualCampaignOptions& options);
/// The same with a damper of its own in each strut, in their order.
std::vector<VirtualRide> virtual_campaign(const InPlantSetup& setup,
                                          std::span<const DamperModel* const> dampers,
                                          const VirtualCampaignOptions& options);

}  // namespace dashpot
