#include <memory>

#include "campaign.h"
#include "commands.h"
#include "console.h"
#include "data.h"

namespace dashpot::cli {
namespace {

struct Settings {
  CampaignSettings campaign;
  std::string folder = "dashpot-bench";
};

constexpr std::string_view kExample =
    "# A campaign with twice the usual noise, and what identification makes of it:\n"
    "dashpot bench --noise 0.02 --output virtual\n"
    "dashpot identify virtual/ --output results\n"
    "\n"
    "# One motion at three voltages:\n"
    "dashpot bench --motions 10x1 --levels 0,1,2 --output small";

int run(const Settings& settings, Console& console) {
  const ParameterSet damper = load_parameter_set(settings.campaign.damper);
  const Dataset campaign = run_campaign(settings.campaign, damper);
  console.check_stop();
  const std::filesystem::path statement =
      write_campaign(campaign, damper, settings.folder, console.command_line());
  console.talk(damper.damper + "; " + damper.source + '\n');
  if (!damper.verified) console.note("these parameters are an example: " + damper.reason);
  console.print(summary(campaign) + "\n\nRecordings  " + settings.folder + "/*.csv\nConditions  " +
                statement.string() + "\nNext        dashpot identify " + shell_quoted(settings.folder) +
                '\n');
  if (console.json)
    console.print_json(Value::object({{"folder", settings.folder},
                                      {"dataset", statement.string()},
                                      {"records", campaign.records.size()},
                                      {"truth", damper.model.to_json()}}));
  return kDone;
}

}  // namespace

Command bench_command() {
  auto settings = std::make_shared<Settings>();
  Command command{
      .name = "bench",
      .title = "Record a virtual damper on a virtual test bench",
      .description =
          "Drives a damper with known parameters through sines and constant currents, measures it with "
          "imperfect sensors (noise, resolution, zero drift) and writes the recordings as CSV files with a "
          "dataset file beside them: to try Dashpot out, to test a method on a known truth, to plan a "
          "campaign before the real bench is booked.",
      .options = campaign_options(settings->campaign),
      .example = std::string(kExample),
      .run = [settings](Console& console) { return run(*settings, console); }};
  command.options.push_back({.names = "-o,--output",
                             .target = &settings->folder,
                             .help = "folder for the recordings",
                             .value = "DIR",
                             .takes = Takes::Folder});
  return command;
}

}  // namespace dashpot::cli
