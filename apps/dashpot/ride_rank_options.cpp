#include "ride_rank_options.h"

#include <algorithm>
#include <array>

#include "console.h"

namespace dashpot::cli {

RideRankSettings::RideRankSettings() {
  vehicle.plant.clear();
  road.road.clear();
}

std::vector<Option> ride_rank_options(RideRankSettings& settings) {
  std::vector<Option> options;
  for (auto group : {controlled_vehicle_options(settings.vehicle), road_options(settings.road)})
    append(options, group);

  // The models are the dampers, and the seed is that of the fits.
  constexpr std::array<std::string_view, 2> kTaken{"--damper", "--seed"};
  std::erase_if(options, [&](const Option& option) {
    return std::ranges::find(kTaken, option.long_name()) != kTaken.end();
  });
  for (Option& option : options) {
    if (option.long_name() == "--plant")
      option.help =
          "ride the models in this vehicle too, and rank them by the error of the ride: " +
          option.help;
    if (option.long_name() == "--plant") option.default_text = "none";
    if (option.long_name() == "--road") option.default_text = RideRankOptions{}.road;
  }
  append(options, {{.names = "--draws",
                    .target = &settings.draws,
                    .help = "dampers that the recordings allow, beside which each model is ridden",
                    .value = "N",
                    .minimum = 2}});
  return options;
}

std::optional<RideRankOptions> stated_ride(const RideRankSettings& settings,
                                           const RankingSettings& ranking, Console& console) {
  if (settings.vehicle.plant.empty()) {
    const RideRankSettings unasked;
    if (settings.vehicle != unasked.vehicle || settings.road != unasked.road ||
        settings.draws != unasked.draws)
      throw UsageError("--plant", "how to ride is stated, and there is no vehicle to ride in",
                       "name one with --plant");
    return std::nullopt;
  }

  // Everything that can be refused is, before the first fit.
  require_effect(settings.vehicle, !settings.vehicle.controller.empty(), "");
  RoadChoice road = settings.road;
  if (road.road.empty()) road.road = RideRankOptions{}.road;
  RideRankOptions options{.vehicle = words_of(settings.vehicle),
                          .road = road.road,
                          .draws = settings.draws,
                          .seed = ranking.fit.options.seed,
                          .threads = ranking.fit.options.threads,
                          .monitor = console.monitor()};
  options.vehicle.sensors.seed = options.seed;
  require_ridable(options);
  const GroundPointer ground = ground_of(road, options.seed, load_plant(options.vehicle).plant);
  options.duration = duration_of(road, *ground);
  return options;
}

void ride_models(Ranking& ranking, const Dataset& dataset,
                 const std::optional<RideRankOptions>& ride, Console& console) {
  if (!ride) return;
  predict_rides(ranking, dataset, *ride);
  if (!ranking.ridden) console.warn("no model can be ridden; the table says why");
}

}  // namespace dashpot::cli
