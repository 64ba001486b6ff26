// Compiled once per instruction set; DASHPOT_RIDES names the function that hands out the result.
#include "dashpot/suspension/lanes/simd/adaptive.h"
#include "dashpot/suspension/lanes/simd/laws.h"
#include "dashpot/suspension/lanes/simd/run.h"
#include "dashpot/suspension/lanes/simd/tables.h"

namespace dashpot {
namespace {

template <class Damper>
void run_with(const LaneRide& ride) {
  if (ride.lags)
    LaneRun<Damper, AdaptiveSteps<Damper, true>>(ride).run();
  else
    LaneRun<Damper, AdaptiveSteps<Damper, false>>(ride).run();
}

void run(const LaneRide& ride) noexcept {
  if (ride.kind == LaneDamperKind::Network) return run_with<NetworkLanes>(ride);
  with_law(ride.law, [&]<class Damper>() { run_with<Damper>(ride); });
}

constexpr RideKernel kKernel{kWidth, &run};

}  // namespace

const RideKernel& DASHPOT_RIDES() { return kKernel; }

}  // namespace dashpot
