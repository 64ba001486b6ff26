#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/identify/judge/error_model.h"
#include "dashpot/monitor.h"
#include "dashpot/rank.h"
#include "dashpot/simulate.h"
#include "dashpot/vehicle.h"

namespace dashpot {

// Models in the machine that they will drive. The error of a model on the bench is one of the force
// along the bench's motions; in a vehicle the force decides on the motion, at other speeds and
// frequencies, and an error that shakes the body counts other than one that hardly moves it.
//
// There is one damper, and the left-out errors of all models tell of it. Each has its ErrorModel;
// the model whose errors leave least unexplained, with an error drawn from them, is a damper that
// the recordings allow. Draws of it take the place of the damper: every model is ridden, and beside
// it, in the same vehicle under the same controller, each of these dampers. Thus the first model is
// judged by its own errors alone, and the others by their distance from what is known. (Each model
// with errors of its own does worse: docs/suspension.md has the figures.)

/// Of a ride: what passengers, tyres and stops feel.
enum RideQuantity : std::size_t { kComfort, kTyreLoad, kTravel };
constexpr std::size_t kRideQuantities = 3;

/// The quantities over time, from the instant on that counts: of comfort one signal, of the others
/// one per tyre and per strut. m/s^2 (weighted by Wk), % of the static load, mm.
using RideSignals = std::array<std::vector<std::vector<double>>, kRideQuantities>;
/// discard: s at the start that do not count.
RideSignals ride_signals(const Plant& plant, const Record& trace, double discard);

/// How far a ride lies from another one, the worst signal of each quantity.
struct RideDifference {
  std::array<double, kRideQuantities> trace{};   ///< rms of the difference
  std::array<double, kRideQuantities> excess{};  ///< of the rms, above the reference's
  double share = 0;  ///< %: rms over the quantities of `trace` over the reference's rms
};
/// Both of the same plant and length.
RideDifference ride_difference(const RideSignals& ride, const RideSignals& reference);

/// The vehicle in which models are ridden, the road, and how much chance is in it.
struct RideRankOptions {
  VehicleWords vehicle;  ///< its dampers are the models
  std::string road = "iso8608,class=C";
  double duration = 20;  ///< s
  int draws = 20;        ///< of the damper, at least 2
  std::uint64_t seed = 1;
  int threads = 0;
  Monitor monitor;
};

/// Refuses what cannot be ridden, before long work. Throws Error: a plant without a place for a
/// damper or without tyres, a road that does not suit it, words that name nothing.
void require_ridable(const RideRankOptions& options);

/// A damper in place of a vehicle's own: a force, and the lag of its coil.
struct OtherDamper {
  std::shared_ptr<const DamperModel> model;
  double lag_rate = 0;  ///< 1/s; 0: no lag
};

/// Dampers as the recordings allow them: the model with an error of its own, drawn so many times.
std::vector<OtherDamper> possible_dampers(const ModelFile& model, const ErrorModel& errors,
                                          const RideRankOptions& options);

/// A model that was ridden in the vehicle that was made for it.
class RiddenModel {
 public:
  /// Rides it. The ground and the options must outlive it. Throws Error where the words fit nothing
  /// and where the ride diverges.
  RiddenModel(const ModelFile& model, const GroundMotion& ground, const RideRankOptions& options);

  /// How far its ride lies from that with this damper in its place, in equilibrium at rest, under
  /// the same controller, which knows the model and nothing of the damper. Nothing where that
  /// diverges.
  std::optional<RideDifference> against(const OtherDamper& damper) const;
  /// The same against each of them: medians, and intervals between their 5 % and 95 % quantiles,
  /// widened for what a vehicle asks beyond the bench.
  PredictedRide predicted(std::span<const OtherDamper> dampers) const;

 private:
  Trace ride(const std::vector<MountedDamper>& dampers) const;

  const RideRankOptions& options_;
  const GroundMotion& ground_;
  Vehicle vehicle_;
  RideSignals own_;
  std::vector<std::string> warnings_;
};

/// Rides each model of the ranking that may be recommended, and states in it what came out
/// (RankedModel::ride); of the others, why not. Without any, Ranking::ridden stays empty. The same
/// bits on any number of threads.
void predict_rides(Ranking& ranking, const Dataset& dataset, const RideRankOptions& options);

}  // namespace dashpot
