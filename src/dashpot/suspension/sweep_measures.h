#pragma once
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "dashpot/suspension/vehicle.h"

namespace dashpot {

/// What a ride of a sweep comes to. Of several struts and tyres the worst one counts; not a number where the
/// ride diverged.
struct RideMeasures {
  double body_acceleration, weighted_acceleration, vibration_dose, tyre_load_index, contact_lost, travel,
      greatest_travel, stops_met, energy, current, outside_data;
  double diverged_at = std::numeric_limits<double>::quiet_NaN();

  bool has_diverged() const { return diverged_at == diverged_at; }
};

struct SweepMeasure {
  std::string_view name, unit, title, meaning;
  double RideMeasures::* field;
};
/// In the order of RideMeasures; the last is when a ride diverged.
std::span<const SweepMeasure> sweep_measures();
/// Those that a ride is judged by: all but the last.
std::span<const SweepMeasure> judged_measures();

}  // namespace dashpot
