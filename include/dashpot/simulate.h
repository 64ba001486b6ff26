// Layer: suspension
#pragma once

// A plant on its ground, with dampers and perhaps a controller, over time. simulate() gives a
// Trace, whose record is a Record like any measured one. SI.

#include <optional>
#include <string>
#include <vector>

#include "dashpot/controller.h"
#include "dashpot/drive.h"
#include "dashpot/ground_motion.h"
#include "dashpot/monitor.h"
#include "dashpot/mounted_damper.h"
#include "dashpot/plant.h"
#include "dashpot/record.h"

namespace dashpot {

/// How long and how exactly simulate() runs, and the sensors and limits of the controller.
struct SimulateOptions {
  double duration = 10;    ///< s
  double output_step = 0;  ///< s, of the trace; 0: the controller's sample time, or 1 ms
  double discard = 0;      ///< s at the start, which shares of the time leave out
  double relative_tolerance = 1e-6, absolute_tolerance = 1e-9;
  /// s: the longest step, taken without control of the error. None: steps as the tolerances ask.
  std::optional<double> step;
  SensorOptions sensors;
  ControlLimits limits;
  Monitor monitor;
};

/// A plant on its ground with dampers and, perhaps, a controller. All of it belongs to the caller.
struct Setting {
  const Plant& plant;
  const std::vector<MountedDamper>& dampers;  ///< one per strut
  const GroundMotion& ground;
  const Controller* controller = nullptr;    ///< null: each damper keeps its current
  DriveUnit drive_unit = DriveUnit::Ampere;  ///< of the trace's currents and commands
};

/// The outcome of a simulation, as a record: per coordinate q, q' and q''; per point its height and
/// acceleration; per strut deflection, velocity, force, current, command; per tyre road height,
/// deflection, load. "body", "body_velocity", "body_acceleration", "suspension_force", "tyre_load"
/// ...
struct Trace {
  Record record;
  std::optional<double> diverged_at;  ///< s; the record ends there
  std::vector<std::string> warnings;
  double contact_lost = 0;  ///< share of the time in which some tyre has no load (contact_lost())
  std::size_t steps = 0;    ///< of the integrator, and how often it asked for all forces
  std::size_t evaluations = 0;
};

/// Throws Error where the parts do not fit together.
void require_fitting(const Setting& setting, const SimulateOptions& options);

/// Runs the setting from rest on the ground as it is at t = 0. Samples of the controller, instants
/// of the output and jumps of the ground are met exactly. Between them plant and dampers are
/// integrated as one system with the error controlled, where every model's states have rates
/// (DamperModel::flows); else, and with fixed steps, the linear part moves exactly under forces
/// that are parabolas within a step. Throws Error as require_fitting().
Trace simulate(const Setting& setting, const SimulateOptions& options);

}  // namespace dashpot
