#include <memory>

#include "commands.h"
#include "console.h"
#include "identify_in_plant.h"
#include "ranking_run.h"
#include "ride_rank_options.h"

namespace dashpot::cli {
namespace {

struct IdentifySettings {
  RankingSettings ranking;
  RideRankSettings ride;
  KitSettings kit;
  std::string validate;  ///< further recordings, never fitted; empty: none
  bool keep_inertia = false;
  InPlantSettings plant;
};

constexpr std::string_view kIdentifyExample =
    "# Each condition in turn is left out to judge the models:\n"
    "dashpot identify recordings/ --output results\n"
    "\n"
    "# Two models only, judged on currents that they have not seen:\n"
    "dashpot identify recordings/ --models bingham,tanh_kwok --leave-out current\n"
    "\n"
    "# More time for what is tried unasked; or every model that there is:\n"
    "dashpot identify recordings/ --budget 10\n"
    "dashpot identify recordings/ --models all\n"
    "\n"
    "# The next damper of the series: start from its neighbour's model, and judge on another day:\n"
    "dashpot identify second/ --models tanh_kwok --from results/models/tanh_kwok.json \\\n"
    "    --validate second-day-two/\n"
    "\n"
    "# Interrupted? The same command goes on where it stopped.\n"
    "dashpot identify recordings/ --models all\n"
    "\n"
    "# Nobody measured the damper's force, but the car's road, accelerations and deflection:\n"
    "dashpot identify drive.csv --in car.yaml --models modified_bouc_wen\n"
    "\n"
    "# Then read results/report.html, and use the best model:\n"
    "dashpot evaluate results/models/tanh_kwok.json more-recordings/";

/// Recordings that no fit sees, refused before the first one where they cannot be used.
std::optional<Dataset> further_recordings(const IdentifySettings& asked, const Dataset& fitted,
                                          Console& console) {
  if (asked.validate.empty()) return std::nullopt;
  DataSettings settings = asked.ranking.data;
  settings.paths = {asked.validate};
  settings.load.dataset_file.clear();
  Dataset further = load_recordings(settings, console);
  require_further(further, fitted);
  return further;
}

int run_identify(const IdentifySettings& asked, Console& console) {
  const RankingSettings& settings = asked.ranking;
  if (!asked.plant.plant.empty()) return run_in_plant(asked.plant, settings, console);

  // All that may be refused is read before the first fit.
  const std::optional<RideRankOptions> ride = stated_ride(asked.ride, settings, console);
  RankingData data = ranking_data(settings, console);
  const std::unique_ptr<FitStore> store = fit_store(settings, console);
  const ChosenModels models = chosen_models(settings.fit, data.dataset, data.leave_out, console);
  const std::optional<Dataset> further = further_recordings(asked, data.dataset, console);
  IdentifyOptions options = identify_options(settings.fit, models.names, console);
  options.from = first_starts(settings.fit, models.names, data.dataset);

  Ranking ranking =
      asked.keep_inertia
          ? rank(models.names, data.dataset, data.leave_out, options, store.get())
          : rank_without_inertia(models.names, data.dataset, data.leave_out, options, store.get());
  if (further) validate(ranking, *further, options);
  tell_kept(ranking.kept_fits, console);

  ranking.budget = models.budget;
  ride_models(ranking, data.dataset, ride, console);

  // One document behind the terminal, the folder of results and JSON.
  const ReportInput input = report_input(data.dataset, ranking, settings.results.units, console);
  const Document report = ranking_document(input);
  print_results(report, ranking, console);
  write_results(input, report, settings.results, console);
  write_kit(input, asked.kit, settings.results, console);
  if (console.json) console.print_json(document_json(report));
  return exit_code_of(ranking, console);
}

}  // namespace

Command identify_command() {
  auto settings = std::make_shared<IdentifySettings>();
  Command command{
      .name = "identify",
      .title = "Turn recordings into ranked damper models and a report",
      .description =
          "Fits each model to all training records together and judges it in free run (motion "
          "and current in, force out) on records that it has not seen. Ranks the models by "
          "that error, saves each as a file and writes a report. Finished fits are kept in "
          "DIR: the same command goes on where it was interrupted.",
      .options = ranking_options(settings->ranking),
      .example = std::string(kIdentifyExample),
      .run = [settings](Console& console) { return run_identify(*settings, console); },
      .likewise = {"fit", "train", "calibrate"}};

  // The effort, what a fit starts from, and what judges it beside the records left out.
  append(command.options, {budget_option(settings->ranking.fit, budget_of_groups()),
                           fresh_option(settings->ranking)});
  append(
      command.options,
      {from_option(settings->ranking),
       {.names = "--validate",
        .target = &settings->validate,
        .help = "further recordings that no fit sees: the final models are judged on them "
                "beside the records left out",
        .value = "FOLDER",
        .takes = Takes::File},
       {.names = "--keep-inertia",
        .target = &settings->keep_inertia,
        .help = "leave the force as it was recorded where the errors left out show the inertia of "
                "what moves between load cell and damper"}});
  append(command.options, kit_options(settings->kit));

  // The vehicle that the models are ridden in, or the plant that the damper was recorded in.
  const std::vector<Option> ride = ride_rank_options(settings->ride);
  append(command.options, ride);
  append(command.options, in_plant_options(settings->plant, ride));
  return command;
}

}  // namespace dashpot::cli
