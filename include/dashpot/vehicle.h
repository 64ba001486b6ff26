// Layer: suspension
#pragma once

// A plant with its dampers, made from words such as those of the command line. A Vehicle owns all
// that simulate() refers to, and must outlive the Settings it gives.

#include <optional>
#include <string>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/model_file.h"
#include "dashpot/plant.h"
#include "dashpot/simulate.h"

namespace dashpot {

/// A plant with its dampers and what drives them, in the words of the command line and of a sweep's
/// file.
struct VehicleWords {
  /// A set, a kind of plant, or a file of the form of data/plants.
  std::string plant = "savaresi_spelta";
  std::vector<std::string> values;  ///< in place of the plant's: "sprung_mass=350 kg"
  /// One per strut, or one for all, as choose_damper() has them. Empty: the plant's own range as an
  /// ideal damper.
  std::vector<std::string> dampers;
  std::string controller;  ///< "mix1,crossover=1.9Hz"; empty: every damper keeps `current`
  /// Scheme or file, from a wanted force to a current; empty: damping is mapped.
  std::string inverse;
  std::string force_loop;     ///< about the inverse: "proportional=0.5,integral=20"; empty: none
  double current = 0;         ///< A (or V), where there is no controller
  double current_max = 0;     ///< A (or V); 0: that of the damper's data
  double lag_rate = -1;       ///< 1/s, of the coil; below 0: the damper's own
  double sample_time = 1e-3;  ///< s, of the controller
  SensorOptions sensors;
  std::string where = "vehicle";  ///< stands in messages
};

/// A word that these would have without effect: what serves a controller where there is none, or a
/// current where a controller chooses its own.
struct IdleWord {
  std::string key;         ///< "current", "inverse", "force_loop", "in_car" or "delay"
  std::string why, right;  ///< "serves a controller, and there is none"
};
std::vector<IdleWord> idle_words(const VehicleWords& words);

/// The vehicle that these words describe.
struct Vehicle {
  PlantSet set;
  std::vector<MountedDamper> dampers;          ///< one per strut
  std::vector<std::string> damper_names;       ///< one per strut
  std::vector<std::optional<Domain>> domains;  ///< where each damper's data were
  /// Of the dampers; None: a place between 0 and 1, or nothing drives them.
  DriveUnit drive_unit = DriveUnit::None;
  ControllerPointer controller;  ///< null: none
  std::string controller_name;   ///< as it was named; empty: none
  ControlLimits limits;
  SensorOptions sensors;
  std::vector<std::string> notes;     ///< "the numbers of ... are an example: ..."
  std::vector<std::string> warnings;  ///< what its dampers are known to do wrong

  /// This vehicle on a ground, which must outlive the setting.
  Setting on(const GroundMotion& ground) const {
    // What nothing drives has channels of 0 A.
    const bool driven = limits.current_min < limits.current_max;
    return {set.plant, dampers, ground, controller.get(), driven ? drive_unit : DriveUnit::Ampere};
  }
  /// Options of simulate() for a run of that many seconds, with this vehicle's sensors and limits.
  SimulateOptions options(double duration) const;
};

/// The plant of these words alone, with their values in place of its own.
PlantSet load_plant(const VehicleWords& words);

/// Makes the vehicle, in equilibrium at rest: the force that a damper has at rest at no deflection
/// and its first current is taken off its model, since the springs bear it. Throws Error(where,
/// ...) at a word that names nothing, at a value outside its bounds, at parts that do not fit
/// together.
Vehicle make_vehicle(const VehicleWords& words);
/// The same with the damper of this model in every strut, in place of the words' dampers.
Vehicle make_vehicle(const VehicleWords& words, const ModelFile& damper);

}  // namespace dashpot
