#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dashpot/monitor.h"
#include "dashpot/rank.h"
#include "studies/ride_rank/true_dampers.h"

namespace dashpot {

class FitStore;

/// A test of what `rank --plant` predicts: dampers whose truth is known, of other structure than
/// the models, are recorded on the virtual bench and ranked; then the truth itself is ridden.
struct RideRankStudyOptions {
  std::vector<std::string> truths;  ///< of true_dampers(); empty: all
  std::vector<std::string> models = {
      "bingham",  "chebyshev", "lookup_map",  "semi_phenomenological",
      "tanh_guo", "tanh_kwok", "viscous_dahl"};
  std::vector<std::string> roads = {"iso8608,class=B,speed=30", "iso8608,class=C,speed=20",
                                    "iso8608,class=D,speed=12", "bump,height=5cm"};
  std::vector<std::string> controllers = {"none", "skyhook", "mix1"};  ///< none: 1 A throughout
  std::string plant = "savaresi_spelta";
  double duration = 10;  ///< s, of each ride
  int draws = 5;         ///< of errors, for each model in each ride
  std::uint64_t seed = 1;
  int threads = 0;
  Monitor monitor;
};

/// A model in one ride.
struct PredictedAndTrue {
  std::string model;
  double esr = 0;      ///< %, on the bench, left out
  Estimate predicted;  ///< %, PredictedRide::error
  double truth = 0;    ///< %, RideDifference::share against the true damper
};

/// One true damper on one road under one controller.
struct RideRankCase {
  std::string truth, road, controller;
  std::vector<PredictedAndTrue> models;
};

/// How well an order of models tells the order of their true ride errors; mean over cases.
struct OrderQuality {
  double correlation = 0;  ///< Spearman's
  double regret = 0;       ///< true error of the model that stands first, over the least of all
};
/// What came out of some cases, those of two models at least.
struct RideRankQuality {
  std::size_t cases = 0;
  OrderQuality predicted, esr;
  double covered = 0;  ///< share of the models whose true error lies within the predicted interval
};
RideRankQuality quality_of(std::span<const RideRankCase> cases);

/// Every true damper, road and controller; models that cannot be ridden are left out of their
/// cases. With a store, finished fits are kept. The same bits on any number of threads. Throws
/// Error at an unknown name, Interrupted when stopped.
std::vector<RideRankCase> study_ride_rank(const RideRankStudyOptions& options, FitStore* store);

}  // namespace dashpot
