#pragma once
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "dashpot/drive.h"
#include "dashpot/suspension/lanes/batch.h"
#include "dashpot/vehicle.h"

namespace dashpot {

/// The figures of one ride of a sweep. Of several struts and tyres the worst one counts; all but
/// the last are not a number where the ride diverged.
struct RideMeasures {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double body_acceleration = kNone, weighted_acceleration = kNone, vibration_dose = kNone;
  double tyre_load_index = kNone, contact_lost = kNone;
  double travel = kNone, greatest_travel = kNone, stops_met = kNone;
  double energy = kNone, current = kNone, outside_data = kNone, diverged_at = kNone;

  bool has_diverged() const { return !std::isnan(diverged_at); }
};

struct SweepMeasure {
  std::string_view name, unit, title, meaning;
  double RideMeasures::* field;
};
/// In the order of RideMeasures; the last is when a ride diverged.
std::span<const SweepMeasure> sweep_measures();
/// The measures that a ride is judged by: all but the last.
std::span<const SweepMeasure> judged_measures();

/// The measure as a sweep has it whose dampers are all driven by that unit: the one of the drive is
/// a current, a voltage or a place from 0 to 1; without a unit, any of these.
const SweepMeasure& as_driven(const SweepMeasure& measure, const std::optional<DriveUnit>& drive);

/// Whether the vehicle's measures need more than simulate_batch() sums up: it has stops, limits of
/// data or several tyres.
bool needs_trace(const Vehicle& vehicle);
/// Measures of the ride from `discard` s on. The result holds the trace where it is needed.
RideMeasures measure_ride(const Vehicle& vehicle, const BatchResult& result, double discard);

}  // namespace dashpot
