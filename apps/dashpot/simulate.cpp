#include <filesystem>
#include <memory>

#include "commands.h"
#include "console.h"
#include "dashpot/base/escape.h"
#include "dashpot/record/record_file.h"
#include "dashpot/record/sample_columns.h"
#include "dashpot/report/simulation_document.h"
#include "dashpot/suspension/trace.h"
#include "document_text.h"
#include "study_results.h"
#include "units.h"
#include "vehicle_options.h"
#include "vehicle_sheet.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

struct SimulateSettings {
  VehicleChoice vehicle;
  RoadChoice road;
  StudyResults results;
  std::string list, against, samples, units;
  double allowed_outside = 5, tolerance = 1e-6, step = 0;  // %, 1, ms
  bool mat = false;
};

constexpr std::string_view kSimulateExample =
    "# A quarter car over a class C road, its ideal damper ruled by one accelerometer:\n"
    "dashpot simulate --controller mix1\n"
    "\n"
    "# An identified damper in the one-sensor paper's car over its step, with page and trace:\n"
    "dashpot simulate --plant tudon_martinez2012 --damper results/models/tanh_kwok.json \\\n"
    "    --controller skyhook --inverse numeric --road step,height=3cm --output ride\n"
    "\n"
    "# The three-storey building of Dyke et al. in the El Centro earthquake, damper off:\n"
    "dashpot simulate --plant dyke_spencer1996 --damper spencer1997,x0=0 \\\n"
    "    --road earthquake,file=el_centro_g.dat,unit=g0,time_scale=0.2 --against viscous,damping=0";

Simulation simulate_choice(const SimulateSettings& settings, Console& console) {
  const VehicleWords words = words_of(settings.vehicle);
  Vehicle driven = make_vehicle(words);
  const GroundPointer ground = ground_of(settings.road, settings.vehicle.seed, driven.set.plant);
  if (sides_meet_one_road(driven.set.plant, *ground))
    driven.notes.emplace_back(
        "left and right wheels meet the same road, so that the car does not roll; "
        "'track_width=1.5m' of the road gives each side its own");
  const std::string foot = foot_of(driven.set.plant);
  if (foot != "tyre")
    driven.notes.push_back("the " + foot + " stands on the ground itself: no vehicle is between");
  const double duration = duration_of(settings.road, *ground);
  const double discard = usual_discard(*ground, duration);
  if (ground->is_steady() && discard == 0)
    driven.notes.emplace_back(
        "too short a run to leave out its start, in which vehicle and weighting settle: a_w is not "
        "yet that of this ground");
  const auto vehicle = std::make_shared<const Vehicle>(std::move(driven));

  // Both runs have the same options, so that they can be compared.
  const RunOptions options{
      .duration = duration,
      .allowed_outside = settings.allowed_outside / 100,
      .relative_tolerance = settings.tolerance,
      .step = settings.step > 0 ? std::optional(settings.step / 1000) : std::nullopt,
      .monitor = console.monitor()};

  Simulation simulation{.run = run_vehicle(vehicle, *ground, options),
                        .ground = ground->description(),
                        .duration = options.duration,
                        .discard = discard};

  // A controlled vehicle is compared with a passive one unless the user forbids it.
  if (settings.against == "none" || (settings.against.empty() && !vehicle->controller))
    return simulation;
  const auto passive =
      std::make_shared<const Vehicle>(make_vehicle(passive_words(words, settings.against)));
  simulation.against = run_vehicle(passive, *ground, options);
  return simulation;
}

void write_trace(const SimulateSettings& settings, const SimulatedRun& run, const std::string& name,
                 Console& console) {
  const fs::path file =
      fs::path(settings.results.folder) / (name + (settings.mat ? ".mat" : ".csv"));
  if (settings.mat)
    save_mat(run.trace.record, file);
  else
    save_csv(run.trace.record, file, file_units(settings.units));
  console.print("Trace    " + file.string() + '\n');
}

int run_simulate(const SimulateSettings& settings, Console& console) {
  if (!settings.list.empty()) {
    print_list(settings.list, console);
    return kDone;
  }

  const PrintUnits units = page_units(settings.units);
  require_effect(settings.vehicle, !settings.vehicle.controller.empty(), settings.against);

  // A folder that cannot be written is found out before the run, not after it.
  if (!settings.results.folder.empty()) prepare_study(settings.results);
  const Simulation simulation = simulate_choice(settings, console);
  Document document = simulation_document(simulation);
  document.units = units;
  const Value data = simulation_json(simulation);

  // What programs draw: the run, and the one that it is compared with.
  if (!settings.samples.empty()) {
    std::vector<Record> runs{simulation.run.trace.record};
    if (simulation.against) runs.push_back(simulation.against->trace.record);
    write_sample_columns(runs, settings.samples);
  }

  // Without a folder the terminal has the table alone.
  if (settings.results.folder.empty()) {
    print_document(document, console);
    if (console.json) console.print_json(presentable(data));
  } else {
    write_study(document, data, settings.results, console);
    write_trace(settings, simulation.run, "trace", console);
    if (simulation.against) write_trace(settings, *simulation.against, "against", console);
  }

  return unusable(simulation.run).empty() ? kDone : kNotUsable;
}

}  // namespace

Command simulate_command() {
  auto settings = std::make_shared<SimulateSettings>();
  Command command{
      .name = "simulate",
      .title = "Drive a vehicle with a damper and a controller over a road",
      .description =
          "Puts a damper (a model file, a published one, a passive curve, or an ideal one) into a "
          "vehicle or a building, a controller with its sensors behind it and a road or an "
          "earthquake below, and reports the ride: comfort by ISO 2631-1, tyre load, travel, "
          "force, energy; after a step how it settles; against the same plant with a passive "
          "damper. Warns of what cannot be trusted: lost contact, end stops that were hit, a "
          "damper used beyond its data.",
      .options = controlled_vehicle_options(settings->vehicle),
      .example = std::string(kSimulateExample),
      .run = [settings](Console& console) { return run_simulate(*settings, console); }};

  // The road below, and the passive vehicle for comparison.
  append(command.options, road_options(settings->road));

  append(
      command.options,
      {{.names = "--against",
        .target = &settings->against,
        .help = "the passive vehicle to compare with: a damper's words, current=A for the same "
                "damper at that current, or none",
        .value = "WORDS",
        .default_text = "beside a controller the plant's nominal damping, or half of the current"},

       // The limits of trust: the range of the data and the accuracy of the integration.
       {.names = "--outside",
        .target = &settings->allowed_outside,
        .help = "share of the time, %, that a damper may be outside its data without a warning",
        .value = "%",
        .minimum = 0},
       {.names = "--tolerance",
        .target = &settings->tolerance,
        .help = "relative tolerance of the integrator",
        .value = "NUMBER"},
       {.names = "--max-step",
        .target = &settings->step,
        .help = "fixed step of the integrator, ms, without error control: quicker, for dampers "
                "without hysteresis",
        .value = "MS",
        .minimum = 0,
        .default_text = "as the tolerance asks"},

       // The files of the results.
       {.names = "-o,--output",
        .target = &settings->results.folder,
        .help = "folder for the page and the traces",
        .value = "DIR",
        .takes = Takes::Folder,
        .default_text = "none: only the table"},
       units_option(settings->units),
       {.names = "--mat",
        .target = &settings->mat,
        .help = "traces as MATLAB files instead of CSV",
        .needs = "--output"},
       {.names = "--samples",
        .target = &settings->samples,
        .help = "also write all samples of the traces as plain doubles, for programs that draw",
        .value = "DIR",
        .takes = Takes::Folder},
       figures_option(settings->results.figures),
       list_option(settings->list)});
  for (Option& option : command.options)
    if (option.long_name() == "--figures") option.needs = "--output";
  return command;
}

}  // namespace dashpot::cli
