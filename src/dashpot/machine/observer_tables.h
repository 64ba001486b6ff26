#pragma once
#include <memory>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/suspension/observe/plant_observer.h"

namespace dashpot {

/// s: an error with this memory stays what it is all along a recording.
constexpr double kStayingError = 1e4;

/// An error of the model's force that comes and goes: a first-order process.
struct ForceError {
  double deviation = 0;  ///< N
  double memory = 0;     ///< s, in which it is forgotten
};

/// A model's force goes by a velocity beside the damper's, and so bends where the damper's does
/// not: a shift that comes and goes, a first-order process.
struct VelocityShift {
  double deviation = 0;  ///< m/s; 0: there is none
  double memory = 0;     ///< s, in which it is forgotten
};

/// What is uncertain of a plant with known dampers, as standard deviations, SI.
struct ObserverNoise {
  std::vector<ForceError> force;  ///< of a damper's model, their sum; of this size in each damper
  VelocityShift shift;            ///< of each damper's model
  std::vector<double> sensors;    ///< per sensor, white
  double roughness = 0;           ///< m^3, G_d(n0) of a road that nothing measures
  /// m, how far apart tracks of an isotropic surface are as alike as those of such a road, which a
  /// filter takes for independent; 0: there are none side by side.
  double track_width = 0;
  /// Between samples road and errors go in straight lines and not at random, as fits that look
  /// for the law and 'watch' have it: motion is known closer where the road is smooth over a
  /// sample, and its bands are too narrow.
  bool is_straight = false;
};

/// A damper in a plant, and the domain of its data.
struct ObservedDamper {
  std::shared_ptr<const DamperModel> model;
  Domain domain;
};
/// In the order of the plant's struts.
using ObservedDampers = std::vector<ObservedDamper>;

/// How large the motion is, for the steps of differences and for what is not known at the start.
struct ObserverScale {
  double stroke = 0, speed = 0, force = 0;  ///< m, m/s, N: half spans, of several dampers the
                                            ///< greatest
  std::vector<double> state;                ///< of each number of each damper's state
  std::vector<double> offset;               ///< per sensor
};
/// By moving the model through its domain, or usual_domain() where that says no motion.
ObserverScale observer_scale(const DamperModel& damper, const Domain& domain);
ObserverScale observer_scale(const ObservedDampers& dampers);

/// The filter of this plant. Heights of a road that nothing measures follow
///   w' = -2 pi n_c V w + 2 pi n0 sqrt(G_d(n0) V) xi,  n_c = 0.01 cycle/m,
/// whose density is that of ISO 8608 above n_c. There are as many models as the plant has dampers.
/// Throws Error where numbers of the plant, delays or cut-offs are unknown.
ObserverTables observer_tables(const InPlantSetup& setup,
                               const std::vector<std::shared_ptr<const DamperModel>>& dampers,
                               const ObserverNoise& noise, const ObserverScale& scale,
                               double sample_time, int steps);
/// damper: the name of the model, which an export tells.
ObserverNames observer_names(const InPlantSetup& setup, const std::string& damper = "");

/// The channels of the inputs that are measured, in the order of the filter.
std::vector<std::string> measured_inputs(const InPlantSetup& setup);

}  // namespace dashpot
