#include <algorithm>
#include <cmath>
#include <memory>

#include "bench_family.h"
#include "bench_in_plant.h"
#include "campaign.h"
#include "commands.h"
#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/report/provenance.h"
#include "production_line.h"
#include "sequence_sheet.h"
#include "units.h"

namespace dashpot::cli {
namespace {

struct BenchSettings {
  CampaignSettings campaign;
  FamilyBenchSettings family;
  std::string folder = "dashpot-bench";
  bool list_sequences = false;
  LineSettings line;
  PlantBenchSettings in_plant;
  double scatter = NAN;  ///< of builds or of a line; NaN: as usual for each
};

constexpr std::string_view kBenchExample =
    "# A campaign with twice the usual noise, and what identification makes of it:\n"
    "dashpot bench --noise 0.02 --output virtual\n"
    "dashpot identify virtual/ --output results\n"
    "\n"
    "# One motion at three voltages:\n"
    "dashpot bench --motions 10x1 --levels 0,1,2 --output small\n"
    "\n"
    "# Transients: a chirp under random levels; an experiment of the one-sensor paper:\n"
    "dashpot bench --damper mr1 --motion FM,duration=20 --drive APRBS --output transient\n"
    "dashpot bench --damper mr1 --experiment one-sensor-2 --output stepped\n"
    "\n"
    "# A production line: 100 dampers, some of them faulty, for 'dashpot identify-many line':\n"
    "dashpot bench --dampers 100 --motions 10x2 --levels 0,1 --cycles 2 --output line\n"
    "\n"
    "# A family: two builds of every drawing in a folder, with a fluid of your own:\n"
    "dashpot bench --family drawings/ --builds 2 --fluid my_fluid.yaml --scatter 0.03 "
    "--levels 0,0.5,1 --output family\n"
    "\n"
    "# Rides of a car with the damper in it, for 'identify --in' and 'observe':\n"
    "dashpot bench --in car.yaml --levels 0,1,2 --duration 20 --output rides";

int list_sequences(Console& console) {
  if (console.json)
    console.print_json(sequences_json());
  else
    console.print(sequences_text(console.width()));
  return kDone;
}

/// The name of the first record with a sample that is not finite; empty: none.
std::string first_infinite(const Dataset& campaign) {
  for (const Record& record : campaign.records)
    for (const Channel& channel : record.channels)
      if (!std::ranges::all_of(channel.samples, [](double x) { return std::isfinite(x); }))
        return record.name;
  return {};
}

int run_family(const BenchSettings& settings, Console& console) {
  if (settings.campaign.damper != CampaignSettings().damper)
    throw UsageError("--damper", "is not benched beside a family", "leave one of them out");
  const FamilyBench made =
      bench_family(settings.family, settings.campaign, settings.folder, console.command_line());

  for (const std::string& warning : made.warnings) console.warn(warning);

  // What was recorded, where it lies, and the command that fits a family to it.
  console.print(std::to_string(made.drawings) + " drawings, " + std::to_string(made.dampers) +
                " dampers, " + std::to_string(made.records) + " records\n\nRecordings  " +
                settings.folder + "/*.csv\nDrawings    " + settings.folder +
                "/drawings/*.yaml, by manifest.csv\nConditions  " + made.statement.string() +
                "\nNext        dashpot rank " + shell_quoted(settings.folder) +
                " --models family --force-offset none\n");
  if (console.json)
    console.print_json(Value::object({{"folder", settings.folder},
                                      {"dataset", made.statement.string()},
                                      {"drawings", made.drawings},
                                      {"dampers", made.dampers},
                                      {"records", made.records}}));
  return kDone;
}

int run_bench(BenchSettings& settings, Console& console) {
  if (settings.list_sequences) return list_sequences(console);
  page_units(settings.campaign.units);
  if (!settings.in_plant.plant.empty())
    return record_in_plant(settings.in_plant, settings.campaign, settings.folder, console);

  // One option for what scatters, builds of drawings or dampers of a line.
  if (settings.scatter >= 1)
    throw UsageError("--scatter",
                     "is " + format_number(settings.scatter) + ", a share of 1 or more",
                     "5 % is 0.05");
  if (std::isfinite(settings.scatter))
    settings.family.scatter = settings.line.scatter = settings.scatter;
  if (!settings.family.drawings.empty()) return run_family(settings, console);
  const FamilyBenchSettings usual;
  if (!settings.family.fluids.empty() || settings.family.builds != usual.builds ||
      settings.family.asymmetry != 0 || settings.family.give != usual.give ||
      (std::isfinite(settings.scatter) && settings.line.dampers == 0))
    throw UsageError("--family", "is missing: fluids, builds and their scatter are a family's",
                     "--family drawings/");

  if (is_path(settings.campaign.damper))
    throw UsageError("--damper", "is a file, and a bench drives published dampers",
                     "with --in PLANT it drives that of a model file");

  if (settings.line.dampers > 0)
    return record_line(settings.line, settings.campaign, settings.folder, console);

  // The whole campaign is recorded before the first file is written.
  const ParameterSet damper = load_parameter_set(settings.campaign.damper);
  const Dataset campaign = run_campaign(settings.campaign, damper);
  console.check_stop();
  if (const std::string where = first_infinite(campaign); !where.empty()) {
    console.error("the damper gives no finite force in " + where +
                  ": nothing is written. Its levels go from " + format_number(damper.drive_min) +
                  " to " + format_number(damper.drive_max));
    return kNotUsable;
  }
  const std::filesystem::path statement = write_campaign(
      campaign, damper, settings.folder, console.command_line(), settings.campaign.units);

  // The user reads which damper this was, and with which command to go on.
  console.talk(damper.damper + "; " + damper.source + '\n');
  if (!damper.verified) console.note("these parameters are an example: " + damper.reason);
  if (const std::string note =
          levels_note(settings.campaign, damper.drive_max, damper.model.drive_unit());
      !note.empty())
    console.note(note);
  console.print(summary(campaign) + "\n\nRecordings  " + settings.folder + "/*.csv\nConditions  " +
                statement.string() + "\nNext        dashpot identify " +
                shell_quoted(settings.folder) + '\n');

  if (console.json)
    console.print_json(Value::object({{"folder", settings.folder},
                                      {"dataset", statement.string()},
                                      {"records", campaign.records.size()},
                                      {"truth", damper.model.to_json()}}));
  return kDone;
}

}  // namespace

Command bench_command() {
  auto settings = std::make_shared<BenchSettings>();
  Command command{.name = "bench",
                  .title = "Record a virtual damper on a virtual test bench",
                  .description =
                      "Drives a damper with known parameters through sines and constant currents, "
                      "or through the sequences of a system identification (chirps, stepped "
                      "frequencies, a rough road; random currents), measures it with imperfect "
                      "sensors (noise, resolution, zero drift) and writes the recordings as CSV "
                      "files with a dataset file beside them: to try Dashpot out, to test a method "
                      "on a known truth, to plan a campaign before the real bench is booked.",
                  .options = campaign_options(settings->campaign),
                  .example = std::string(kBenchExample),
                  .run = [settings](Console& console) { return run_bench(*settings, console); }};

  append(command.options, family_bench_options(settings->family));
  command.options.push_back({.names = "-o,--output",
                             .target = &settings->folder,
                             .help = "folder for the recordings",
                             .value = "DIR",
                             .takes = Takes::Folder});
  append(command.options, line_options(settings->line));
  command.options.push_back(
      {.names = "--scatter",
       .target = &settings->scatter,
       .help = "standard deviation, as a share: of a build's flow and friction from its drawing, "
               "or of each parameter over a line",
       .value = "SHARE",
       .minimum = 0,
       .default_text = "0.03 for builds, 0.02 over a line"});
  append(command.options, plant_bench_options(settings->in_plant));
  Option units = units_option(settings->campaign.units);
  units.help = "units of the recordings, as lbf,in/s";
  units.default_text = "N, mm and m/s";
  command.options.push_back(std::move(units));
  command.options.push_back(
      {.names = "--sequences",
       .target = &settings->list_sequences,
       .help = "list sequences, their parameters and the experiments; record nothing"});
  return command;
}

}  // namespace dashpot::cli
