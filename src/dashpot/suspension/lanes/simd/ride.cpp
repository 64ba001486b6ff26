// Compiled once per instruction set; DASHPOT_RIDES names the function that returns this set's
// kernel.
#include "dashpot/suspension/lanes/simd/adaptive.h"
#include "dashpot/suspension/lanes/simd/car_steps.h"
#include "dashpot/suspension/lanes/simd/laws.h"
#include "dashpot/suspension/lanes/simd/run.h"
#include "dashpot/suspension/lanes/simd/tables.h"
#include "dashpot/suspension/lanes/simd/taylor.h"

namespace dashpot {
namespace {

/// Quarter cars with as many currents behind lags as the ride has, or other vehicles.
template <class Damper>
void run_with(const LaneRide& ride) {
  if (ride.equations) return LaneRun<CarLanes<Damper>, CarSteps<Damper>>(ride).run();
  switch (ride.lags) {
    case 0:
      return LaneRun<QuarterCarLanes<Damper>, AdaptiveSteps<Damper, 0>>(ride).run();
    case 1:
      return LaneRun<QuarterCarLanes<Damper>, AdaptiveSteps<Damper, 1>>(ride).run();
    default:
      return LaneRun<QuarterCarLanes<Damper>, AdaptiveSteps<Damper, 2>>(ride).run();
  }
}

/// The relative tolerance from which on a force may be of single precision, which is true to 1e-7.
constexpr double kFinestOfFloats = 5e-7;

/// Whether TaylorSteps suit the ride: of quarter cars with a network that TanhNeurons can expand,
/// and no stops, friction, lift or lags.
bool has_series(const LaneRide& ride) {
  // The motion enters the network by velocity alone.
  const LaneNetwork& network = *ride.network;
  bool by_velocity = false, by_displacement = false;
  for (std::size_t i = 0; i < network.layers[0].inputs; ++i) {
    by_velocity = by_velocity || network.inputs[i] == LaneInput::Velocity;
    by_displacement = by_displacement || network.inputs[i] == LaneInput::Displacement;
  }

  return !ride.equations && ride.moderate && by_velocity && !by_displacement && ride.lags == 0 &&
         !ride.resists_more && network.count == 2 &&
         network.layers[0].activation == Activation::Tanh &&
         network.layers[1].activation == Activation::Identity;
}

template <class Neurons>
void run_series(const LaneRide& ride) {
  LaneRun<QuarterCarLanes<Neurons>, TaylorSteps<Neurons>>(ride).run();
}

void run(const LaneRide& ride) noexcept {
  if (ride.kind == LaneDamperKind::Network && has_series(ride))
    return ride.relative_tolerance < kFinestOfFloats ? run_series<TanhNeurons<double>>(ride)
                                                     : run_series<TanhNeurons<float>>(ride);
  if (ride.kind == LaneDamperKind::Network) return run_with<NetworkLanes>(ride);
  with_law(ride.law, [&]<class Damper>() { run_with<Damper>(ride); });
}

constexpr RideKernel kKernel{kWidth, &run};

}  // namespace

const RideKernel& DASHPOT_RIDES() { return kKernel; }

}  // namespace dashpot
