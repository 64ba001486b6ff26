#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/suspension/ride/ride_measures.h"
#include "dashpot/vehicle.h"

namespace dashpot {

/// A vehicle's run with its measures and warnings.
struct SimulatedRun {
  std::string name;  ///< "mix1", "viscous, 1500 N*s/m"
  std::shared_ptr<const Vehicle> vehicle;
  Trace trace;
  std::vector<RideMeasure> measures;
  /// The trace's, and those of dampers that were asked beyond their data.
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  ///< of the ride, whoever rides: its road ends
};

struct RunOptions {
  double duration = 10;           ///< s
  double allowed_outside = 0.05;  ///< share of the time that a damper may be outside its data
  double relative_tolerance = 1e-6;
  std::optional<double> step = {};  ///< s, as in SimulateOptions
  Monitor monitor;
};

/// Simulates and measures it. Throws Error as simulate() does.
SimulatedRun run_vehicle(const std::shared_ptr<const Vehicle>& vehicle, const GroundMotion& ground,
                         const RunOptions& options);

/// Why nothing of a run can be used, as a sentence: it diverged, or it moves as no vehicle does.
/// Empty: it can be used.
std::string unusable(const SimulatedRun& run);

/// The name of a run: the controller, or the dampers and the current that drives them.
std::string name_of(const Vehicle& vehicle);

/// The same plant without a controller, to compare with. against: a damper's words; or
/// "current=..." for the same dampers at that current; empty: the plant's nominal damping where the
/// dampers are ideal, else the same dampers at half of their current. Throws Error(where, ...).
VehicleWords passive_words(const VehicleWords& words, const std::string& against);

}  // namespace dashpot
