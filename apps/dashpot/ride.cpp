#include <memory>

#include "commands.h"
#include "console.h"
#include "dashpot/base/units.h"
#include "dashpot/report/ride_document.h"
#include "study_results.h"
#include "vehicle_options.h"
#include "vehicle_sheet.h"

namespace dashpot::cli {
namespace {

struct RideSettings {
  VehicleChoice vehicle;
  RoadChoice road = {.road = RideStudyOptions{}.road, .duration = RideStudyOptions{}.road_duration};
  StudyResults results = {.folder = "dashpot-ride"};
  std::string controllers = "skyhook;skyhook_linear;groundhook;add;pdd;sh_add;mix1", against, list;
  std::vector<std::string> frequencies;
  double amplitude = 5, step = 30, allowed_outside = 5;                   // mm, mm, %
  double settling = GainOptions{}.settling, chirp = GainOptions{}.chirp;  // s
  int held = 12, threads = 0;
  bool bound = false;
};

constexpr std::string_view kRideExample =
    "# The usual controllers in a quarter car with an ideal damper, against a passive one:\n"
    "dashpot ride\n"
    "\n"
    "# The one-sensor paper's car and an identified damper; sensors as in a car:\n"
    "dashpot ride --plant tudon_martinez2012 --damper results/models/tanh_kwok.json \\\n"
    "    --controllers \"skyhook;mix1,crossover=2Hz;sh_add\" --in-car --output ride\n"
    "\n"
    "# Every law on a worse road, passive at 1000 N*s/m:\n"
    "dashpot ride --controllers all --road iso8608,class=D --against viscous,damping=1000";

std::vector<double> frequencies_of(const RideSettings& settings) {
  std::vector<double> frequencies;
  for (const std::string& text : settings.frequencies)
    frequencies.push_back(parse_quantity(text, "Hz", "--frequencies"));
  return frequencies.empty() ? usual_frequencies() : frequencies;
}

RideStudyOptions options_of(const RideSettings& settings, Console& console) {
  return {.vehicle = words_of(settings.vehicle),
          .controllers = words_between(settings.controllers),
          .against = settings.against,
          .frequencies = frequencies_of(settings),
          .gains = {.amplitude = settings.amplitude / 1000,
                    .settling = settings.settling,
                    .chirp = settings.chirp},
          .road = settings.road.road,
          .road_duration = settings.road.duration,
          .step_height = settings.step / 1000,
          .held = static_cast<std::size_t>(settings.held),
          .bound = settings.bound,
          .allowed_outside = settings.allowed_outside / 100,
          .seed = settings.vehicle.seed,
          .threads = settings.threads,
          .monitor = console.monitor()};
}

int run_ride(const RideSettings& settings, Console& console) {
  if (!settings.list.empty()) {
    print_list(settings.list, console);
    return kDone;
  }

  require_effect(settings.vehicle, true, settings.against);

  // A folder that cannot be written is found out before the ride, not after it.
  prepare_study(settings.results);
  const RideStudy study = study_ride(options_of(settings, console));
  write_study(ride_document(study), ride_json(study), settings.results, console);
  return kDone;
}

std::vector<Option> study_options(RideSettings& settings) {
  return {
      {.names = "--controllers",
       .target = &settings.controllers,
       .help = "control laws with their settings, ';' between; or all (--list controllers)",
       .value = "LIST"},
      {.names = "--against",
       .target = &settings.against,
       .help = "the passive reference: a damper's words, or current=A for the same damper at that "
               "current",
       .value = "WORDS",
       .default_text = "the plant's nominal damping, or half of the current"},

      // The sines and the chirp that give the gain curves.
      {.names = "--frequencies",
       .target = &settings.frequencies,
       .help = "frequencies of the sines, Hz, in rising order",
       .value = "LIST",
       .default_text = "18 from 0.5 to 20"},
      {.names = "--amplitude",
       .target = &settings.amplitude,
       .help = "amplitude of sines and chirp, mm",
       .value = "MM"},
      {.names = "--settling",
       .target = &settings.settling,
       .help = "settling time before the periods of a sine that count, s",
       .value = "S",
       .minimum = 0},
      {.names = "--chirp",
       .target = &settings.chirp,
       .help = "how long the chirp lasts, s",
       .value = "S",
       .minimum = 1},

      // The step, and the trade-off beside which the controllers stand.
      {.names = "--step",
       .target = &settings.step,
       .help = "height of the step, mm",
       .value = "MM"},
      {.names = "--held",
       .target = &settings.held,
       .help = "currents at which the same dampers are held, for the trade-off's line",
       .value = "N",
       .minimum = 2},

      // The optimum for comparison, and when a damper counts as asked beyond its data.
      {.names = "--bound",
       .target = &settings.bound,
       .help = "also show the optimum on the road: a bound that no controller beats, and the "
               "result of the best one that knows the road (quarter cars, dampers without memory)"},
      {.names = "--outside",
       .target = &settings.allowed_outside,
       .help = "share of the time, %, that a damper may be outside its data without a warning",
       .value = "%",
       .minimum = 0}};
}

}  // namespace

Command ride_command() {
  auto settings = std::make_shared<RideSettings>();
  Command command{
      .name = "ride",
      .title = "Compare controllers in a vehicle, over frequency and on a road",
      .description =
          "Rides one vehicle with several controllers and without: gains from the road to body and "
          "tyre by sines and by a chirp, a rough road, a step. The page has every controller as a "
          "ratio to passive, the gain curves with the one-sensor paper's limits, and comfort "
          "against road holding beside what the same dampers do when they are held at one drive.",
      .options = vehicle_options(settings->vehicle),
      .example = std::string(kRideExample),
      .run = [settings](Console& console) { return run_ride(*settings, console); }};

  // The controllers and excitations, then the road and the results.
  append(command.options, study_options(*settings));
  append(command.options, road_options(settings->road));
  append(command.options, {threads_option(settings->threads),
                           {.names = "-o,--output",
                            .target = &settings->results.folder,
                            .help = "folder for the page",
                            .value = "DIR",
                            .takes = Takes::Folder},
                           figures_option(settings->results.figures),
                           list_option(settings->list)});
  return command;
}

}  // namespace dashpot::cli
