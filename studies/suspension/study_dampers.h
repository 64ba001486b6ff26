#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "dashpot/damper_model.h"
#include "dashpot/evaluate.h"

// The dampers of the suspension study: recorded on a virtual bench and identified anew.
namespace dashpot {

/// A damper that was recorded on the virtual bench and identified by the paper's network: v, i, ten
/// neurons. Beyond the bench's velocities, where a network says nothing, its force goes on
/// straight.
struct NetworkDamper {
  std::string name, description;
  std::shared_ptr<const DamperModel> model;  ///< without force at rest
  double fastest = 0;                        ///< m/s, in the recordings that taught it
  Metrics quality;                           ///< on recordings that the network has not seen
  double half_span = 0;                      ///< N, of the forces there
};

/// MR2, a virtual damper, by the paper's network. The seed sets noise, motion and first weights.
NetworkDamper identified_mr2(std::uint64_t seed);
/// A production damper's curve, scaled until it damps like `damping`, N*s/m, at the wheel's
/// resonance: along a sine of 20 mm at 1 m/s; by the same network.
NetworkDamper identified_passive(double damping, std::uint64_t seed);

}  // namespace dashpot
