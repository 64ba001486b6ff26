// Compiled once per instruction set; DASHPOT_RIDES names the function that hands out the result.
#include "dashpot/suspension/lanes/simd/adaptive.h"
#include "dashpot/suspension/lanes/simd/laws.h"
#include "dashpot/suspension/lanes/simd/run.h"
#include "dashpot/suspension/lanes/simd/tables.h"

namespace dashpot {
namespace {

template <class Damper>
void run_with(const LaneRide& ride) {
  switch (ride.lags) {
    case 0:
      return LaneRun<Damper, AdaptiveSteps<Damper, 0>>(ride).run();
    case 1:
      return LaneRun<Damper, AdaptiveSteps<Damper, 1>>(ride).run();
    default:
      return LaneRun<Damper, AdaptiveSteps<Damper, 2>>(ride).run();
  }
}

void run(const LaneRide& ride) noexcept {
  if (ride.kind == LaneDamperKind::Network) return run_with<NetworkLanes>(ride);
  with_law(ride.law, [&]<class Damper>() { run_with<Damper>(ride); });
}

constexpr RideKernel kKernel{kWidth, &run};

}  // namespace

const RideKernel& DASHPOT_RIDES() { return kKernel; }

}  // namespace dashpot
