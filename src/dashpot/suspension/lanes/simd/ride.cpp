// Compiled once per instruction set; DASHPOT_RIDES names the function that returns this set's
// kernel.
#include "dashpot/suspension/lanes/simd/adaptive.h"
#include "dashpot/suspension/lanes/simd/laws.h"
#include "dashpot/suspension/lanes/simd/run.h"
#include "dashpot/suspension/lanes/simd/tables.h"
#include "dashpot/suspension/lanes/simd/taylor.h"

namespace dashpot {
namespace {

/// With as many currents behind lags as the ride has.
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

/// The relative tolerance from which on a force may be of single precision, which is true to 1e-7.
constexpr double kFinestOfFloats = 5e-7;

/// Whether TaylorSteps suit the ride: a network that TanhNeurons can expand, and no stops,
/// friction, lift or lags.
bool has_series(const LaneRide& ride) {
  // The motion enters the network by velocity alone.
  const LaneNetwork& network = *ride.network;
  bool by_velocity = false, by_displacement = false;
  for (std::size_t i = 0; i < network.layers[0].inputs; ++i) {
    by_velocity = by_velocity || network.inputs[i] == LaneInput::Velocity;
    by_displacement = by_displacement || network.inputs[i] == LaneInput::Displacement;
  }

  return ride.moderate && by_velocity && !by_displacement && ride.lags == 0 && !ride.resists_more &&
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
