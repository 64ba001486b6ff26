#pragma once
#include <set>

#include "dashpot/export/c/c_control_law.h"
#include "dashpot/vehicle.h"

namespace dashpot {

/// All of a controller's C code but the interface's functions, with what the interface must know.
struct CControlPath {
  std::string code;  ///< strut_rest, strut_signals, strut_demand, strut_command
  std::vector<const StrutSignal*> measured;  ///< the fields of damper_signals
  std::size_t strut_state = 0;               ///< numbers of the state per strut
  std::size_t plant_states = 0;
  bool has_integrals = false;  ///< makes velocities by integration
  bool has_slopes = false;     ///< makes velocities by differences
};
/// The path of a vehicle that has a controller. Throws Error where a law has no C text, or where
/// struts have different dampers behind an inverse.
CControlPath c_control_path(const Vehicle& vehicle);

}  // namespace dashpot
