#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "dashpot/suspension/lanes/batch_vehicle.h"

namespace dashpot {

struct BatchOptions {
  double duration = 10;  ///< s
  double discard = 0;    ///< s at the start that the measures leave out
  double relative_tolerance = 1e-6, absolute_tolerance = 1e-9;
  int threads = 1;      ///< 0: all cores. Results are the same bits for any number
  bool traces = false;  ///< keep each ride's trace as well
  Monitor monitor;
};

/// Measures of a ride, from its samples at the controller's sample time (or 1 ms). The body is the
/// plant's first coordinate; of several struts and tyres the worst one counts.
struct BatchMeasures {
  double body_acceleration = 0;      ///< m/s^2, root mean square
  double weighted_acceleration = 0;  ///< m/s^2, by Wk of ISO 2631-1: a_w
  double vibration_dose = 0;         ///< m/s^1.75, VDV by Wk
  double tyre_load = 0;              ///< N, root mean square of the load less that at rest
  double tyre_deflection = 0;        ///< m, root mean square
  double deflection = 0;             ///< m, root mean square of the strut's travel
  double greatest_deflection = 0;    ///< m, greatest magnitude
  double contact_lost = 0;           ///< share of the time in which some tyre has no load
  double energy = 0;                 ///< J, that the dampers took
  double current = 0;                ///< A (or V), mean over time and dampers
};

struct BatchResult {
  BatchMeasures measures;             ///< up to the divergence where there is one
  std::optional<double> diverged_at;  ///< s
  bool in_lanes = false;              ///< false: such a vehicle has no lanes, simulate() did it
  bool missed_tolerance = false;      ///< at some instant
  std::size_t evaluations = 0;        ///< of its forces
  Record trace;  ///< where wanted: channels named as those of simulate(), its main ones
};

/// Many vehicles side by side in the lanes of the processor, one result each. Lanes take quarter,
/// half and full cars, and other plants on tyres that are no larger, with any controller, sensors
/// and ground that does not jump, whose dampers are static networks (of tanh, sigmoid or ReLU
/// neurons) or of a law that has lanes (kLaneLaws), of one kind in all struts and with numbers of
/// their own, behind drivers without limited rate and sampling of their own; all others go through
/// simulate() one by one (reason_against_lanes() says why). A result does not depend on what else
/// is in the batch; batches of one or two vehicles, which ride on shorter vectors, may differ in
/// the last digits. Roads take memory: give thousands of vehicles in blocks of some hundred. Throws
/// Error as simulate() does, naming the vehicle.
std::vector<BatchResult> simulate_batch(std::span<const BatchVehicle> vehicles,
                                        const BatchOptions& options);

}  // namespace dashpot
