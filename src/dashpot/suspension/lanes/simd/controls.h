#pragma once
#include "dashpot/suspension/lanes/ride.h"
#include "dashpot/suspension/lanes/simd/lane_math.h"

// The control laws that ride in lanes: those with two states, hard and soft, and no memory. Each is
// the C text of its law, in which the build has written Lane for each double (law_texts.cmake). To
// add one: name it there and in kLaneControls, and give it a case below.
namespace dashpot {
namespace {
namespace lane_controls {

// What the texts ask for (suspension/control/c_text/demand.h), a number per lane each.
struct StrutSignals {
  Lane body_velocity, body_acceleration, wheel_velocity, deflection_velocity;
};
struct ControlLimits {
  Lane damping_min, damping_max;
};
struct DamperDemand {
  Lane value;
};
inline DamperDemand hard_when(LaneMask hard, const ControlLimits* limits) {
  return {hard ? limits->damping_max : limits->damping_min};
}

#include "lanes/control_texts.h"

/// The demand of a law by its place in kLaneControls.
inline Lane demand_of(std::size_t law, Lane parameter, const ControlLimits& limits,
                      const StrutSignals& s) {
  static_assert(sizeof kLaneControls == 5 * sizeof *kLaneControls, "one case per law, in order");
  switch (law) {
    case 0:
      return add_demand(&limits, &s).value;
    case 1:
      return groundhook_demand(&limits, &s).value;
    case 2: {
      const Mix1 p{parameter};
      return mix1_demand(&p, &limits, &s).value;
    }
    case 3: {
      const ShAdd p{parameter};
      return sh_add_demand(&p, &limits, &s).value;
    }
    default:
      return skyhook_demand(&limits, &s).value;
  }
}

}  // namespace lane_controls
}  // namespace
}  // namespace dashpot
