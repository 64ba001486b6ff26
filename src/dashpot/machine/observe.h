#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/observer_tables.h"
#include "dashpot/machine/plant_recording.h"
#include "dashpot/machine/plant_smoother.h"
#include "dashpot/model_file.h"
#include "dashpot/monitor.h"

namespace dashpot {

// What no sensor shows of a plant whose dampers are known: their forces (load cells that are not
// there), velocities, the road. A Kalman filter of plant and dampers, and over a recording that is
// whole a smoother behind it, give each of them with a band.

struct ObserveOptions {
  bool causal = false;  ///< only from the past, as on an ECU; else from the whole recording
  std::vector<ForceError> force;  ///< the errors of the model; empty: found, a quick and a slow one
  /// Of the model; none: found beside the errors, where these are not stated, there is one damper
  /// and the noise of each sensor is known, which would pass for a shift.
  VelocityShift shift;
  int steps = 0;  ///< of the filter per sample; 0: as many as its error asks for
  double level = 0.9;
  int threads = 0;
  Monitor monitor;
  bool is_straight = false;  ///< between samples, as in ObserverNoise: for fits and watch
  bool seeks_faults = true;  ///< sensors that are held or drift, which takes longer than the rest
};

/// One quantity over a recording: value - half ... value + half.
struct ObservedQuantity {
  std::string name, unit;
  std::vector<double> value, half;
};

/// How a sensor fits what was expected of it one sample ahead.
struct ObservedSensor {
  std::string channel, unit;
  double rms = 0;       ///< of what it showed, without its mean
  double surprise = 0;  ///< rms of what it showed beyond what was expected
  double inside = 0;    ///< share of the samples inside the band of that
  double offset = 0;    ///< found
};

struct ObservedRecording {
  std::string name;
  double sample_time = 0;
  /// The dampers' forces first, then deflection and velocity of each.
  std::vector<ObservedQuantity> quantities;
  std::vector<ObservedSensor> sensors;
};

/// Where force, deflection and velocity of a damper stand among the quantities, with so many
/// dampers.
struct DamperQuantities {
  std::size_t force = 0, deflection = 0, velocity = 0;
};
constexpr DamperQuantities damper_quantities(std::size_t damper, std::size_t dampers) {
  return {damper, dampers + 2 * damper, dampers + 2 * damper + 1};
}

struct ObserveReport {
  std::vector<std::string> struts;  ///< in which the dampers stand
  std::vector<ObservedRecording> recordings;
  ObserverNoise noise;  ///< stated or found
  int steps = 1;
  bool noise_was_found = false;
  /// Half the 95 % interval of all forces together, as a share of them, where a fit found the
  /// plant's mass: it is in the forces' bands.
  double forces_known_within = 0;
  double seconds = 0;  ///< CPU time
  std::vector<std::string> warnings;
};

/// What the force of the damper in a strut is called, among those of a plant with so many dampers:
/// "damper_force", of several "front_damper_force".
std::string force_name(const std::string& strut, std::size_t dampers);

/// Observes the recordings with these dampers in the plant, all of whose numbers are known: one in
/// each strut, in their order. What is not stated of the uncertainties (the models' errors,
/// sensors' noise, the road's class) is that under which the recordings are most likely; every
/// sensor's stated filter and delay are taken off. Throws Error before long work where a number of
/// the plant is unknown, where a recording is too short, where a damper's model cannot be followed.
/// What a damper has at rest is taken off, since the springs bear it.
ObserveReport observe(ObservedDampers dampers, const InPlantSetup& setup,
                      const std::vector<PlantRecording>& recordings, const ObserveOptions& options);
/// The same with this damper in each strut.
ObserveReport observe(std::shared_ptr<const DamperModel> damper, const Domain& domain,
                      const InPlantSetup& setup, const std::vector<PlantRecording>& recordings,
                      const ObserveOptions& options);

/// The filter alone, with this damper in each strut and all uncertainties stated: what an ECU runs
/// at this sample time, switched on while the plant stands. (From anywhere, single precision would
/// lose its covariance.) Sensors without a noise, or late by more than a tenth of a sample as those
/// behind a filter are, are refused.
PlantObserver make_observer(std::shared_ptr<const DamperModel> damper, const Domain& domain,
                            InPlantSetup setup, double sample_time, const ObserveOptions& options);

/// Throws Error where the damper is driven by another quantity than the plant states.
void require_plant_drive(const InPlantSetup& setup, const ModelFile& file,
                         const std::string& model);

/// A recording as a filter takes it, late sensors brought forward, from behind their own filters.
/// Throws Error where it is too short.
ObservedSamples observed_samples(const InPlantSetup& setup, const PlantRecording& recording);

/// The damper in equilibrium at rest, where the springs bear what it has there.
std::shared_ptr<const DamperModel> mounted(std::shared_ptr<const DamperModel> damper, double drive);
/// That which a damper is taken to be mounted under before anything was recorded: its level, of a
/// channel the least of the model's domain.
double resting_drive(const DamperDrive& drive, const Domain& domain);

}  // namespace dashpot
