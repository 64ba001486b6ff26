#pragma once
#include <vector>

#include "dashpot/mounted_damper.h"
#include "dashpot/suspension/lanes/ride.h"

namespace dashpot {

/// What the dampers of vehicles that ride side by side have in common.
struct LaneDamperShape {
  LaneDamperKind kind = LaneDamperKind::Network;
  LaneNetwork network;   ///< of a network
  std::size_t law = 0;   ///< of a law: its place in kLaneLaws
  std::size_t lags = 0;  ///< currents behind a lag: 0, 1 or 2
  bool operator==(const LaneDamperShape&) const = default;
};

/// Of a network, or of a law that has lanes.
LaneDamperShape lane_damper_shape(const MountedDamper& damper);

/// 1/s, of the model's own lag behind the coil's current; 0: none.
double model_lag_of(const MountedDamper& damper);
/// Adds a strut's part of LaneRide::damper.
void add_lane_damper(const MountedDamper& damper, std::vector<double>& numbers);
/// Adds a strut's part of LaneRide::start: after a long rest.
void add_lane_start(const MountedDamper& damper, std::vector<double>& start);

/// Whether the damper is a network no neuron of whose first layer exceeds kMostAtRest at any of the
/// driver's currents.
bool is_moderate(const MountedDamper& damper);

}  // namespace dashpot
