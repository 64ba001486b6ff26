// Compiled once per instruction set; DASHPOT_RIDES names the function that hands out the result.
#include "dashpot/suspension/lanes/simd/adaptive.h"
#include "dashpot/suspension/lanes/simd/laws.h"
#include "dashpot/suspension/lanes/simd/run.h"
#include "dashpot/suspension/lanes/simd/tables.h"
#include "dashpot/suspension/lanes/simd/taylor.h"

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

constexpr double kFinestOfFloats =
    5e-7;  ///< the tolerance above which a force may be of single precision

/// Whether a network's force is a function of velocity alone that TanhNeurons have, and all else is
/// smooth.
bool has_series(const LaneRide& ride) {
  const LaneNetwork& network = *ride.network;
  bool by_velocity = false, by_displacement = false;
  for (std::size_t i = 0; i < network.layers[0].inputs; ++i) {
    by_velocity = by_velocity || network.inputs[i] == 1;
    by_displacement = by_displacement || network.inputs[i] == 0;
  }
  return by_velocity && !by_displacement && ride.lags == 0 && !ride.resists_more &&
         network.count == 2 && network.layers[0].activation == Activation::Tanh &&
         network.layers[1].activation == Activation::Identity;
}

void run_series(const LaneRide& ride) {
  if (ride.relative_tolerance < kFinestOfFloats)
    LaneRun<TanhNeurons<double>, TaylorSteps<TanhNeurons<double>>>(ride).run();
  else
    LaneRun<TanhNeurons<float>, TaylorSteps<TanhNeurons<float>>>(ride).run();
}

void run(const LaneRide& ride) noexcept {
  if (ride.kind == LaneDamperKind::Network && has_series(ride)) return run_series(ride);
  if (ride.kind == LaneDamperKind::Network) return run_with<NetworkLanes>(ride);
  with_law(ride.law, [&]<class Damper>() { run_with<Damper>(ride); });
}

constexpr RideKernel kKernel{kWidth, &run};

}  // namespace

const RideKernel& DASHPOT_RIDES() { return kKernel; }

}  // namespace dashpot
