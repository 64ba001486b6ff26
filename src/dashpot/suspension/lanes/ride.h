#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "dashpot/damper/nets/kernel.h"
#include "dashpot/suspension/plants/nonlinear_forces.h"

// What passes between simulate_batch and the loops over lanes, which are compiled once per
// instruction set.
namespace dashpot {

/// Everything that one vehicle's equations need, or (Number: a vector) those of a vehicle per lane.
template <class Number>
struct QuarterCarNumbers {
  // q'' = by_state x + by_force F + by_push P;  x = body, wheel and their speeds, F of the strut, P
  // of the road
  Number by_state[2][4], by_force[2], by_push[2];
  TyreContact<Number> tyre;
  StrutResistance<Number> strut;
  Number friction_slope;         ///< s/m, 1 / v_s: over this speed friction sets in
  Number driver_lag, model_lag;  ///< 1/s; 0: none
};

enum class LaneDamperKind { Network, Law };

/// A static network of one output; plain arrays, since the loops call nothing of the standard
/// library.
struct LaneNetwork {
  static constexpr std::size_t kMostLayers = 6;
  struct Layer {
    std::size_t inputs = 0, outputs = 0;
    Activation activation = Activation::Identity;
    bool operator==(const Layer&) const = default;
  };
  std::size_t inputs[3] = {};  ///< 0 displacement, 1 velocity, 2 current
  std::size_t count = 0;
  Layer layers[kMostLayers];
  bool operator==(const LaneNetwork&) const = default;
};

/// One vehicle per lane. Rows of numbers, a number per lane; one behind the other.
struct LaneRide {
  LaneDamperKind kind = LaneDamperKind::Network;
  const LaneNetwork* network = nullptr;
  std::size_t law = 0;   ///< its place in kLaneLaws
  std::size_t lags = 0;  ///< of driver and model, on the way to the current that drives the damper
  bool resists_more = false;  ///< some strut has stops or friction, some tyre may lift
  double relative_tolerance = 0, absolute_tolerance = 0;
  double sample_time = 0;
  std::size_t samples = 0, discarded = 0;
  const double* numbers = nullptr;
  const double* damper =
      nullptr;  ///< weights as Mlp's; or the law's parameters at powers 0 ... 3 of current
  const double* start =
      nullptr;  ///< the command, the coil's current, the model's, then the law's states
  const double* weighting = nullptr;  ///< b0, b1, b2, a1, a2 of each of kWeightingSections

  void* pilot = nullptr;
  /// Height and rate under a lane at kLaneNodes half samples from number `first` on, into rows.
  void (*ground)(void* pilot, std::size_t lane, std::size_t first, double* heights,
                 double* rates) = nullptr;
  /// LaneSignal rows in, commands out: what the driver's limits leave of them. Only lanes of which
  /// `which` is not 0. Null: the commands stay.
  void (*control)(void* pilot, const double* signals, double* commands,
                  const std::int64_t* which) = nullptr;

  double* results = nullptr;  ///< LaneResult rows
  double* trace = nullptr;    ///< samples + 1 times LaneTrace rows; or null
};

constexpr std::size_t kWeightingSections = 4;
constexpr std::size_t kLaneAhead = 64;  ///< samples of road at once: a power of 2
constexpr std::size_t kLaneNodes = 2 * kLaneAhead + 1;
enum LaneSignal : std::size_t {
  kBodyVelocity,
  kBodyAcceleration,
  kWheelVelocity,
  kDeflection,
  kDeflectionVelocity,
  kForce,
  kCurrent,
  kBody,
  kWheel,
  kGround,
  kLaneSignals
};
enum LaneResult : std::size_t {
  kAcceleration2,
  kWeighted2,
  kWeighted4,
  kLoad2,
  kTyreDeflection2,
  kDeflection2,
  kGreatestDeflection,
  kContactLost,
  kPower,
  kCurrentSum,
  kDivergedAt,
  kMissed,
  kEvaluations,
  kLaneResults
};
enum LaneTrace : std::size_t {
  kTraceBody,
  kTraceBodyVelocity,
  kTraceBodyAcceleration,
  kTraceWheel,
  kTraceWheelVelocity,
  kTraceWheelAcceleration,
  kTraceDeflection,
  kTraceDeflectionVelocity,
  kTraceForce,
  kTraceCurrent,
  kTraceRoad,
  kTraceLoad,
  kLaneTraces
};

/// The loops for one instruction set.
struct RideKernel {
  std::size_t lanes;
  void (*run)(const LaneRide& ride) noexcept;
};
/// For so many vehicles: the widest, but for one or two, which the shortest vectors serve sooner.
const RideKernel& ride_kernel(std::size_t vehicles);

/// Names of the laws that have lanes, in alphabetical order. LaneRide::law is a place in this table;
/// simd/laws.h holds their code in the same order.
inline constexpr std::string_view kLaneLaws[] = {"bingham", "bouc_wen", "modified_bouc_wen"};

}  // namespace dashpot
