#pragma once
#include <span>
#include <vector>

#include "dashpot/damper/kinds/passive_network/passive_network_model.h"

namespace dashpot {

/// Where the energy goes that a motion puts into a passive network: J since the first sample, one
/// per sample. work = stored + creep + friction + viscous + inertia, but for the trapezoidal rule.
struct EnergyBalance {
  std::vector<double> work;      ///< of the motion on the damper; the offset's is no part of it
  std::vector<double> stored;    ///< by springs, potential and inertia, beyond the first sample's
  std::vector<double> creep;     ///< drained by resistances that drain at rest, too
  std::vector<double> friction;  ///< by those that drain along the way
  std::vector<double> viscous;   ///< by the viscous term
  std::vector<double> inertia;   ///< by the slip of its mass
};

/// time: s, rising; inputs: one per sample. The model starts at rest there.
EnergyBalance energy_balance(const PassiveNetworkModel& model, std::span<const double> time,
                             std::span<const DamperInput> inputs);

}  // namespace dashpot
