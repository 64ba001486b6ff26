#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"
#include "data.h"
#include "identify_options.h"
#include "results.h"

namespace dashpot::cli {
namespace {

struct Settings {
  DataSettings data;
  FitSettings fit;
  ResultSettings results;
  std::string leave_out;
};

constexpr std::string_view kExample =
    "# Each condition in turn is left out to judge the models:\n"
    "dashpot identify recordings/ --output results\n"
    "\n"
    "# Two models only, judged on currents that they have not seen:\n"
    "dashpot identify recordings/ --models bingham,tanh_kwok --leave-out current\n"
    "\n"
    "# Then read results/report.html, and use the best model:\n"
    "dashpot evaluate results/models/tanh_kwok.json more-recordings/";

/// What the command line says, before the long work begins; nothing when it says nothing.
std::optional<LeaveOut> stated_leave_out(const std::string& text) {
  if (text.empty()) return std::nullopt;
  try {
    return parse_leave_out(text);
  } catch (const Error& error) {
    throw UsageError("--leave-out", error.what());
  }
}

int run(const Settings& settings, Console& console) {
  const std::optional<LeaveOut> stated = stated_leave_out(settings.leave_out);
  const Dataset dataset = load_recordings(settings.data, console);
  prepare_results(settings.results);
  const LeaveOut leave_out = stated ? *stated : default_leave_out(dataset);
  console.talk("judged by leaving out: " + format_leave_out(leave_out) + '\n');
  const std::vector<std::string> models = chosen_models(settings.fit, dataset, console);
  const Ranking ranking = rank(models, dataset, leave_out, identify_options(settings.fit, models, console));
  const ReportInput input = report_input(dataset, ranking, console);
  print_results(input, console);
  write_results(input, settings.results, console);
  if (console.json) console.print_json(json_report(input));
  return exit_code_of(ranking, console);
}

}  // namespace

Command identify_command() {
  auto settings = std::make_shared<Settings>();
  Command command{.name = "identify",
                  .title = "Turn recordings into ranked damper models and a report",
                  .description =
                      "Fits each model to all training records together and judges it in free run (motion "
                      "and current in, "
                      "force out) on records that it has not seen. Ranks the models by that error, saves "
                      "each as a file and "
                      "writes a report.",
                  .options = data_options(settings->data),
                  .example = std::string(kExample),
                  .run = [settings](Console& console) { return run(*settings, console); }};
  command.options.push_back(
      {.names = "--leave-out",
       .target = &settings->leave_out,
       .help = "what is left out to judge a model: condition, current, record, roles or fraction; name which "
               "ones as current=0.5,1 or fraction=0.3",
       .value = "WHAT",
       .default_text = "as the dataset file says, else the first of condition, current, record and "
                       "fraction that the records allow"});
  append(command.options, fit_options(settings->fit));
  append(command.options, result_options(settings->results));
  return command;
}

}  // namespace dashpot::cli
