#pragma once
#include <optional>

#include "dashpot/machine/ride_rank.h"
#include "ranking_run.h"
#include "vehicle_options.h"

namespace dashpot::cli {

/// The vehicle in which `rank` and `identify` ride the models.
struct RideRankSettings {
  RideRankSettings();
  VehicleChoice vehicle;  ///< without a plant: none
  RoadChoice road;
  int draws = RideRankOptions{}.draws;
};

std::vector<Option> ride_rank_options(RideRankSettings& settings);

/// Nothing without a plant. Seed and threads are those of the fits. Throws Error on what cannot be
/// ridden, before the fits; UsageError on a road or a controller without a plant.
std::optional<RideRankOptions> stated_ride(const RideRankSettings& settings,
                                           const RankingSettings& ranking, Console& console);

/// Rides the models, if that was asked for; warns where none could be.
void ride_models(Ranking& ranking, const Dataset& dataset,
                 const std::optional<RideRankOptions>& ride, Console& console);

}  // namespace dashpot::cli
