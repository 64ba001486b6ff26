#pragma once
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "dashpot/damper/nets/kernel.h"
#include "dashpot/suspension/plants/nonlinear_forces.h"

// The data that pass between simulate_batch() and the loops over lanes, which are compiled once per
// instruction set. All arrays are rows of numbers, one number per lane, one row behind the other;
// they belong to the caller. Units are SI.
namespace dashpot {

/// What a strut and its damper add to a vehicle's numbers. Number = double, or a vector of a number
/// per lane; nothing but Numbers here and in QuarterCarNumbers, so that rows of lanes can be made
/// of them (add_numbers() in lane_vehicle.cpp).
template <class Number>
struct StrutNumbers {
  StrutResistance<Number> resistance;
  Number friction_slope;         ///< s/m, 1 / v_s: over this speed friction sets in
  Number driver_lag, model_lag;  ///< 1/s; 0: none
};

/// The numbers of a quarter car's equations:
///   q'' = by_state x + by_force F + by_push P
/// with x = heights of body and wheel and their speeds, F of the strut, P of the road on the wheel.
template <class Number>
struct QuarterCarNumbers {
  Number by_state[2][4], by_force[2], by_push[2];
  TyreContact<Number> tyre;
  StrutNumbers<Number> strut;
};

/// What a vehicle that is no quarter car may have at most: a full car's.
constexpr std::size_t kMostLaneCoordinates = 8, kMostLaneCorners = 4;

/// The equations of a vehicle of n coordinates, with several struts and tyres, as rows of a matrix
/// without its zeros, which are most of it:
///   n rows            q'' by [q, q', forces of the struts, pushes of the road on the tyres]
///   one per strut     its deflection by q (and the speed of that by q')
///   one per strut     the height of its upper end by q
///   one per tyre      the height of its wheel by q
/// Vehicles ride side by side where they have their zeros at the same places. Their numbers are the
/// entries row by row, then TyreContact of each tyre, then StrutNumbers of each strut.
struct LaneEquations {
  static constexpr std::size_t kMostRows = kMostLaneCoordinates + 3 * kMostLaneCorners;
  static constexpr std::size_t kMostColumns = 2 * kMostLaneCoordinates + 2 * kMostLaneCorners;
  static constexpr std::size_t kMostEntries =
      kMostLaneCoordinates * (kMostColumns + 3 * kMostLaneCorners);
  std::size_t coordinates = 0, struts = 0, tyres = 0;  ///< 0: a quarter car
  std::uint16_t begins[kMostRows + 1] = {};  ///< where each row begins; the last one's end
  std::uint8_t columns[kMostEntries] = {};   ///< of each entry
  bool operator==(const LaneEquations&) const = default;
};

/// The greatest sum of a neuron's bias and current, whatever its sign, with which a network's exp
/// may be split into that of the current and that of the velocity.
constexpr int kMostAtRest = 30;

enum class LaneDamperKind { Network, Law };
enum class LaneInput : std::uint8_t { Displacement, Velocity, Current };

/// A static network of one output. Plain arrays, since the loops call nothing of the standard
/// library.
struct LaneNetwork {
  static constexpr std::size_t kMostLayers = 6;
  struct Layer {
    std::size_t inputs = 0, outputs = 0;
    Activation activation = Activation::Identity;
    bool operator==(const Layer&) const = default;
  };
  LaneInput inputs[3] = {};
  std::size_t count = 0;  ///< of layers
  Layer layers[kMostLayers];
  bool operator==(const LaneNetwork&) const = default;
};

/// Coefficients of a law's parameter over current: of its powers 0 to 3.
constexpr std::size_t kLanePowers = 4;

/// A ride of one vehicle per lane: what they have in common, and rows of what differs.
struct LaneRide {
  const LaneEquations* equations = nullptr;  ///< null: of quarter cars
  LaneDamperKind kind = LaneDamperKind::Network;
  const LaneNetwork* network = nullptr;
  std::size_t law = 0;   ///< its place in kLaneLaws
  std::size_t lags = 0;  ///< of driver and model, on the way to the current that drives the damper
  bool resists_more = false;  ///< some strut has stops or friction, some tyre may lift
  bool moderate = false;      ///< no neuron of the first layer exceeds kMostAtRest at rest
  double relative_tolerance = 0, absolute_tolerance = 0;
  double sample_time = 0;           ///< s
  std::size_t samples = 0;          ///< after the one at rest
  std::size_t discarded = 0;        ///< samples that the measures leave out
  const double* numbers = nullptr;  ///< of QuarterCarNumbers, or as LaneEquations has them
  /// Strut by strut, damper_size rows each: weights as Mlp::parameters, then scale and mean of the
  /// output; or kLanePowers times the law's parameters, coefficients of the same power together.
  const double* damper = nullptr;
  std::size_t damper_size = 0;
  /// Strut by strut: the command, the current of the coil and that of the model, then the law's
  /// states.
  const double* start = nullptr;
  const double* weighting =
      nullptr;  ///< b0, b1, b2, a1, a2 of each of kWeightingSections; no lanes

  void* pilot = nullptr;  ///< passed to the two functions below
  /// Height and rate under a lane at kLaneNodes half samples from number `first` on, into rows,
  /// tyre by tyre.
  void (*ground)(void* pilot, std::size_t lane, std::size_t first, double* heights,
                 double* rates) = nullptr;
  /// Rows of LaneControlNumber, strut by strut, for a control law by its place in kLaneControls;
  /// null: `control` is asked.
  std::size_t control_law = 0;
  const double* control_numbers = nullptr;
  /// Signals in: LaneSignal rows of each strut, then q and q', then the road's height under each
  /// tyre. Commands within the drivers' limits out, one per strut, for the lanes whose `which` is
  /// not 0. Null: the commands stay.
  void (*control)(void* pilot, const double* signals, double* commands,
                  const std::int64_t* which) = nullptr;

  double* results = nullptr;  ///< LaneResult, then LaneStrutResult and LaneTyreResult of each
  double* trace = nullptr;    ///< samples + 1 times trace_rows() rows; or null
};

constexpr std::size_t kWeightingSections = 4;
constexpr std::size_t kLaneAhead = 64;                  ///< samples of road at once
constexpr std::size_t kLaneNodes = 2 * kLaneAhead + 1;  ///< start and middle of each, and the end
static_assert((kLaneAhead & (kLaneAhead - 1)) == 0, "a power of 2: places within are a mask");

/// Signals of a strut at a sample.
enum LaneSignal : std::size_t {
  kBodyVelocity,
  kBodyAcceleration,
  kWheelVelocity,
  kDeflection,
  kDeflectionVelocity,
  kForce,
  kCurrent,
  kLaneSignals
};
/// What a control law in lanes knows of its vehicle.
enum LaneControlNumber : std::size_t {
  kControlParameter,
  kSoftCurrent,  ///< A, commanded where the law wants the least damping, and where the most
  kHardCurrent,
  kLaneControlNumbers
};
/// Sums over the samples that count, but for the last three.
enum LaneResult : std::size_t {
  kAcceleration2,  ///< of squares of the body's acceleration, m^2/s^4
  kWeighted2,      ///< of its weighted squares
  kWeighted4,      ///< and of their squares
  kContactLost,    ///< of samples in which some tyre has no load
  kPower,          ///< of all dampers, W; by half of the first and last sample
  kCurrentSum,     ///< of all dampers, A
  kDivergedAt,     ///< the sample; 0: not
  kMissed,         ///< 1 where some step missed the tolerance
  kEvaluations,    ///< steps
  kLaneResults
};
enum LaneStrutResult : std::size_t {
  kDeflection2,         ///< m^2
  kGreatestDeflection,  ///< m, no sum
  kLaneStrutResults
};
enum LaneTyreResult : std::size_t {
  kLoad2,            ///< of squares of the load over that at rest, N^2
  kTyreDeflection2,  ///< m^2
  kLaneTyreResults
};
/// Rows of a trace per sample: of each coordinate its value, rate and acceleration; of each strut
/// deflection, velocity, force and current; of each tyre the road's height and the load.
constexpr std::size_t kCoordinateTraces = 3, kStrutTraces = 4, kTyreTraces = 2;
constexpr std::size_t trace_rows(std::size_t coordinates, std::size_t struts, std::size_t tyres) {
  return kCoordinateTraces * coordinates + kStrutTraces * struts + kTyreTraces * tyres;
}

/// The loops for one instruction set.
struct RideKernel {
  std::size_t lanes;
  void (*run)(const LaneRide& ride) noexcept;
};
/// For a batch of that many vehicles: the widest; for one or two the shortest vectors, which are
/// done sooner.
const RideKernel& ride_kernel(std::size_t vehicles);

/// Names of the laws that have lanes, in alphabetical order. LaneRide::law is a place in this
/// table; simd/laws.h holds their code in the same order.
inline constexpr std::string_view kLaneLaws[] = {"bingham", "bouc_wen", "modified_bouc_wen"};

/// Names of the control laws that have lanes, in alphabetical order: LaneRide::control_law is a
/// place in this table; simd/controls.h holds their code in the same order.
inline constexpr std::string_view kLaneControls[] = {"add", "groundhook", "mix1", "sh_add",
                                                     "skyhook"};
constexpr std::size_t kNoLaneControl = std::size(kLaneControls);

}  // namespace dashpot
