#include "dashpot/rank.h"

#include <cmath>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/base/parallel.h"
#include "dashpot/base/ranks.h"
#include "dashpot/base/text.h"
#include "dashpot/identify/fit/fit_words.h"
#include "dashpot/identify/rank/divisions.h"
#include "dashpot/identify/rank/model_choice.h"
#include "dashpot/identify/rank/rank_and_tell.h"
#include "dashpot/report/words.h"
#include "document_text.h"
#include "many_machines.h"
#include "ranking_run.h"
#include "ride_rank_options.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

struct RankSettings {
  RankingSettings ranking;
  RideRankSettings ride;
  ManyMachines machines;
  bool markdown = false, costs = false;
};

constexpr std::string_view kRankExample =
    "# Every model there is, each judged on records that it has not seen:\n"
    "dashpot rank recordings/ --output ranking\n"
    "\n"
    "# Interrupted? The same command goes on where it stopped. Two laws only, for a page:\n"
    "dashpot rank recordings/ --models bingham,tanh_kwok --output ranking --markdown\n"
    "\n"
    "# By what their errors are worth in a car, on a rough road under skyhook control:\n"
    "dashpot rank recordings/ --plant savaresi_spelta --road iso8608,class=D \\\n"
    "    --controller skyhook --output ranking";

std::string time_line(const Ranking& ranking, int threads) {
  double fits = 0;
  for (const RankedModel& model : ranking.models) fits += model.seconds;
  const auto cores = static_cast<std::size_t>(threads > 0 ? threads : default_threads());
  return fmt::format("{} took {} s on {}; their fits take {} s of CPU time{}.\n",
                     counted(ranking.models.size(), "model"), number_text(ranking.wall_seconds),
                     counted(cores, "thread"), number_text(fits),
                     ranking.kept_fits == 0
                         ? ""
                         : fmt::format("; {} kept from before", counted(ranking.kept_fits, "fit")));
}

/// What each model is estimated to cost on these recordings; nothing is fitted.
int print_costs(const RankingSettings& asked, Console& console) {
  const Dataset dataset = load_recordings(asked.data, console);
  const std::optional<LeaveOut> stated = stated_leave_out(asked.leave_out);
  const Divisions divisions = divide(dataset, stated ? *stated : default_leave_out(dataset));
  const ChosenModels models = choose_models(asked.fit.models, dataset.records);
  Value list = Value::array();
  std::string text;
  for (const std::string& model : models.names) {
    const double seconds = expected_seconds(model, divisions, dataset.drive_unit);
    list.push_back(Value::object({{"model", model}, {"seconds", seconds}}));
    text += fmt::format("{:>10} s  {}\n", number_text(seconds), model);
  }
  console.print(text);
  if (console.json) console.print_json(Value::object({{"costs", std::move(list)}}));
  return kDone;
}

/// What is known of a model before all others have ended, under the leaderboard's names: a line for
/// a program that draws the progress.
void tell_judged(const RankedModel& model, Console& console) {
  if (console.progress != "json" || !model.fit.model) return;
  const auto number = [](double value) { return std::isfinite(value) ? Value(value) : Value(); };
  const Value row = Value::object({{"model", model.name},
                                   {"usable", is_usable(model) ? "yes" : "no"},
                                   {"esr_percent", number(model.left_out.pooled.esr)},
                                   {"worst_esr_percent", number(model.left_out.worst_esr)},
                                   {"dissipates", model.dissipation.dissipates() ? "yes" : "no"}});
  console.talk(format_json(Value::object({{"judged", row}}), false) + "\n");
}

int run_rank(const RankSettings& settings, Console& console) {
  const RankingSettings& asked = settings.ranking;
  if (settings.costs) return print_costs(asked, console);
  const Part part = settle_machines(settings.machines);
  if (are_dealt_out(part) && asked.fresh)
    throw UsageError("--fresh", "keeps no fits, and --part and mpirun share those that are kept",
                     "leave one of them out");
  const std::optional<RideRankOptions> ride = stated_ride(settings.ride, asked, console);
  const RankingData data = ranking_data(asked, console);
  const fs::path folder = asked.results.folder;

  const std::unique_ptr<FitStore> store = fit_store(asked, console);
  const ChosenModels models = chosen_models(asked.fit, data.dataset, data.leave_out, console);
  IdentifyOptions options = identify_options(asked.fit, models.names, console);
  options.from = first_starts(asked.fit, models.names, data.dataset);
  PartReport made;
  if (are_dealt_out(part)) {
    made = rank_part(models.names, data.dataset, data.leave_out, options, *store, part);
    if (ranks().is_worker()) return kDone;
    if (!part.is_all()) return finish_part(made, part, "fit", folder / "fits.sqlite", console);
  }

  // All of it, or what is left to do when the tasks have been shared: to judge.
  Ranking ranking = rank_and_tell(models.names, data.dataset, data.leave_out, options, store.get(),
                                  [&](const RankedModel& model) { tell_judged(model, console); });
  if (!ranks().is_alone()) {
    ranking.kept_fits = made.kept;
    ranking.wall_seconds += made.wall_seconds;
  }
  ranking.budget = models.budget;
  ride_models(ranking, data.dataset, ride, console);
  const ReportInput input = report_input(data.dataset, ranking, asked.results.units, console);

  // The leaderboard is printed; the report that is written has each model in full.
  const Document leaderboard = leaderboard_document(input);
  if (settings.markdown) {
    console.print(markdown_document(leaderboard, "", 2));
  } else {
    print_document(leaderboard, console);
    console.print(time_line(ranking, asked.fit.options.threads));
  }
  write_file(folder / "leaderboard.csv", csv_leaderboard(input));
  const Document report = ranking_document(input);
  write_results(input, report, asked.results, console,
                settings.markdown ? Say::Aside : Say::Result);
  if (console.json) console.print_json(document_json(report));
  return exit_code_of(ranking, console);
}

}  // namespace

Command rank_command() {
  auto settings = std::make_shared<RankSettings>();
  settings->ranking.fit.models = {"all"};
  settings->ranking.results.folder = "dashpot-ranking";
  Command command{.name = "rank",
                  .title = "Every model on one scale: the leaderboard",
                  .description =
                      "Fits every model of the registry as 'identify' does and compares them: "
                      "error on left-out records beside the error on those of the fit, by record, "
                      "speed and drive; number of parameters, cost per step, CPU time of the fit, "
                      "and whether the force stays bounded beyond the data. Finished fits are kept "
                      "in DIR/fits.sqlite: the same command goes on where it was interrupted. With "
                      "--plant the models are also ridden, and ranked by how far their ride will "
                      "lie from that of the damper.",
                  .options = ranking_options(settings->ranking),
                  .example = std::string(kRankExample),
                  .run = [settings](Console& console) { return run_rank(*settings, console); }};

  append(command.options,
         {budget_option(settings->ranking.fit, budget_of_groups()),
          fresh_option(settings->ranking),
          from_option(settings->ranking),
          {.names = "--costs",
           .target = &settings->costs,
           .help = "print the CPU time that the fits of each model are estimated to take, and fit "
                   "none"},
          {.names = "--markdown",
           .target = &settings->markdown,
           .help = "print the tables as a part of a Markdown page, without a date"}});
  append(command.options, ride_rank_options(settings->ride));
  append(command.options, many_machines_options(settings->machines));
  command.over_ranks = true;
  return command;
}

}  // namespace dashpot::cli
