#include <algorithm>
#include <memory>

#include <fmt/core.h>

#include "campaign.h"
#include "commands.h"
#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"
#include "dashpot/rank.h"
#include "data.h"
#include "identify_options.h"
#include "recovery.h"
#include "results.h"

namespace dashpot::cli {
namespace {

/// A campaign that takes seconds to identify and still determines every parameter.
CampaignSettings small_campaign() {
  CampaignSettings campaign;
  campaign.motions = {"25x0.5", "10x1", "5x3", "2x5"};
  campaign.levels = {"0", "0.75", "1.5", "2.25"};
  campaign.bench.cycles = 2;
  campaign.bench.sample_rate = 200;
  return campaign;
}

/// Minutes on two cores for the usual models, and what a passive network trains for in them: a
/// sixth of its usual updates is enough for records this clean.
constexpr double kDemoBudget = 0.25;
constexpr std::string_view kQuickTraining = "epochs=250";

struct DemoSettings {
  CampaignSettings campaign = small_campaign();
  FitSettings fit;
  ResultSettings results{.folder = "dashpot-demo"};
};

constexpr std::string_view kDemoExample =
    "dashpot demo --output demo    # then read demo/report.html\n"
    "\n"
    "# The recordings that it made are ordinary files:\n"
    "dashpot inspect demo/recordings/";

/// Prints the known parameters beside those found; true where each that the data can determine was
/// found.
bool print_recovery(const std::vector<RecoveredParameter>& parameters, Console& console) {
  console.print('\n' + console.bold("Known parameters against those found") + '\n' +
                recovery_table(parameters, console.width()));

  // A parameter that the data cannot determine is not held against the fit.
  const auto missed = std::ranges::count_if(
      parameters, [](const RecoveredParameter& p) { return !p.recovered() && !p.weak; });
  if (missed == 0 && !parameters.empty()) {
    console.print(
        fmt::format("All known parameters that these data can determine are recovered, within "
                    "their joint 95 % interval or {} %.\n",
                    format_number(100 * kRecoveryTolerance)));
    return true;
  }

  console.error(
      fmt::format("{} of {} known parameters were not recovered", missed, parameters.size()));
  return false;
}

const RankedModel& find_model(const Ranking& ranking, const std::string& name) {
  return *std::ranges::find(ranking.models, name, &RankedModel::name);
}

bool trains_passive_network(const ChosenModels& models) {
  return std::ranges::any_of(models.names, [](const std::string& name) {
    return model_info(name).kind == ModelKind::PassiveNetwork;
  });
}

int run_demo(const DemoSettings& settings, Console& console) {
  CampaignSettings campaign = settings.campaign;
  campaign.bench.seed = settings.fit.options.seed;
  const ParameterSet damper = load_parameter_set(campaign.damper);
  prepare_results(settings.results);
  console.talk("Virtual test bench: " + damper.damper + "\n  " + damper.source + '\n');
  const auto statement =
      write_campaign(run_campaign(campaign, damper), damper,
                     settings.results.folder + "/recordings", console.command_line(), {});
  // From here on as with real recordings: the files are all there is.
  const Dataset dataset = load_recordings({.paths = {statement.string()}, .load = {}}, console);

  // The damper's own law is fitted too, so that its parameters can be compared.
  FitSettings fit = settings.fit;
  const std::string truth = damper.model.name();
  fit.models.push_back(truth);

  // A passive network that is tried unasked trains briefly, and the output says so.
  const bool is_quick = fit.network.empty();
  if (is_quick) fit.network.emplace_back(kQuickTraining);
  const LeaveOut leave_out = default_leave_out(dataset);
  const ChosenModels models = chosen_models(fit, dataset, leave_out, console);
  if (is_quick && !trains_passive_network(models))
    fit.network.clear();
  else if (is_quick)
    console.talk(
        fmt::format("passive networks train briefly here, as --network {} says\n", kQuickTraining));
  Ranking ranking =
      rank(models.names, dataset, leave_out, identify_options(fit, models.names, console));
  ranking.budget = models.budget;

  const ReportInput input = report_input(dataset, ranking, settings.results.units, console);
  const Document report = ranking_document(input);
  print_results(report, ranking, console);

  // The demo succeeds where the known parameters are found again.
  const std::vector<RecoveredParameter> parameters =
      compare(damper.model, find_model(ranking, truth).fit);
  const bool recovered = print_recovery(parameters, console);

  write_results(input, report, settings.results, console);
  if (console.json)
    console.print_json(Value::object({{"recovered", recovered},
                                      {"parameters", to_json(parameters)},
                                      {"report", document_json(report)}}));
  return recovered ? exit_code_of(ranking, console) : kNotUsable;
}

}  // namespace

Command demo_command() {
  auto settings = std::make_shared<DemoSettings>();
  settings->fit.budget = kDemoBudget;
  settings->fit.options.starts = 2;  // enough for data this clean, in half the time
  Command command{.name = "demo",
                  .title = "See it at work: a virtual damper, measured and identified",
                  .description =
                      "Records a virtual damper with known parameters, identifies models from the "
                      "files as from a real campaign, checks that the known parameters are found "
                      "again, and writes the report. Needs no data.",
                  .options = fit_options(settings->fit),
                  .example = std::string(kDemoExample),
                  .run = [settings](Console& console) { return run_demo(*settings, console); }};
  command.options.push_back(budget_option(settings->fit, {}));
  append(command.options, result_options(settings->results));
  return command;
}

}  // namespace dashpot::cli
