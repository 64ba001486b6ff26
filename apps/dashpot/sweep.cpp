#include "dashpot/suspension/sweep/sweep.h"

#include <filesystem>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/base/ranks.h"
#include "dashpot/base/text.h"
#include "dashpot/report/sweep_report.h"
#include "dashpot/report/words.h"
#include "dashpot/suspension/sweep/request_file.h"
#include "many_machines.h"
#include "results.h"
#include "study_results.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

struct SweepSettings {
  std::string request;
  StudyResults results = {.folder = "dashpot-sweep"};
  std::uint64_t samples = 0, seed = 0;
  double duration = 0;
  int threads = 0;
  ManyMachines machines;
  bool measures = false;
};

constexpr std::string_view kSweepExample =
    "# Three controllers on the same thousand cars and roads:\n"
    "dashpot sweep comfort --output comfort\n"
    "\n"
    "# Interrupted, or not enough? The same command goes on where it stopped; more samples are "
    "added:\n"
    "dashpot sweep comfort --output comfort --samples 5000\n"
    "\n"
    "# Your own: what varies and how, as docs/sweep.md describes:\n"
    "dashpot sweep my_sweep.yaml --figures";

SweepRequest requested(const SweepSettings& settings) {
  if (settings.request.empty())
    throw UsageError("REQUEST", "is missing: a file, or one of " + join(sweep_names(), ", "));
  SweepRequest request =
      is_path(settings.request) ? load_sweep(settings.request) : named_sweep(settings.request);
  if (settings.samples > 0) request.samples = settings.samples;
  if (settings.seed > 0) request.seed = settings.seed;
  if (settings.duration > 0) request.duration = settings.duration;
  if (!(request.discard < request.duration))
    throw Error("--duration", "nothing is left of " + format_number(request.duration) + " s",
                "more than the " + format_number(request.discard) + " s that are discarded");
  return request;
}

std::string measures_text(int width) {
  std::vector<std::vector<std::string>> rows;
  for (const SweepMeasure& m : sweep_measures())
    rows.push_back({std::string(m.name), std::string(m.unit), std::string(m.meaning)});
  return text_table({{"measure"}, {"unit"}, {"meaning", false, 1, true}}, rows, width);
}

void write_tables(const Sweep& result, const fs::path& folder, Console& console) {
  const std::vector<ColumnTable> tables = sweep_tables(result);
  for (const ColumnTable& table : tables)
    write_file(folder / (table.name + ".csv"), csv_table(table));
  write_hdf5(folder / "sweep.h5", tables,
             {{"command", console.command_line()},
              {"version", DASHPOT_VERSION},
              {"created", date_now()},
              {"name", result.request.name}});
  console.print("Tables   " + (folder / "rides.csv").string() +
                " (also quantiles.csv, ratios.csv, correlations.csv; all in sweep.h5)\n");
}

fs::path store_file(const SweepSettings& settings) {
  return fs::path(settings.results.folder) / "sweep.sqlite";
}

/// Runs the request; each block of rides is kept in the folder of the results as it ends.
Sweep run_sweep(const SweepRequest& request, SweepStore& store, const SweepSettings& settings,
                Console& console) {
  console.talk(fmt::format("sweep: {}, {} each, {} s\n", counted(request.vehicles(), "vehicle"),
                           counted(request.controllers.size(), "controller"),
                           format_number(request.duration)));
  return sweep(request, store, {settings.threads, console.monitor()});
}

int run_sweep(const SweepSettings& settings, Console& console) {
  const Part part = settle_machines(settings.machines);
  if (settings.measures) {
    console.print(measures_text(console.width()));
    return kDone;
  }

  // A folder that cannot be written is found out before the sweep, not after it, and so is a
  // program for the tables that does not run; a part of a sweep needs none.
  const SweepRequest request = requested(settings);
  prepare_study(settings.results);
  if (part.is_all() && !ranks().is_worker()) require_hdf5();

  try {
    const fs::path file = store_file(settings);
    if (settings.results.fresh) Store::remove(file);
    SweepStore store(file, request, program_id());
    tell_dropped(store.dropped(), file, console);
    const std::size_t kept = ranks().is_alone() ? 0 : store.load().size();
    PartReport made;
    if (are_dealt_out(part)) {
      made = sweep_part(request, store, {settings.threads, console.monitor()}, part);
      if (ranks().is_worker()) return kDone;
      if (!part.is_all()) return finish_part(made, part, "block", file, console);
    }
    Sweep result = run_sweep(request, store, settings, console);
    if (!ranks().is_alone()) {
      result.kept = kept;
      result.wall_seconds += made.wall_seconds;
    }
    write_study(sweep_document(result), sweep_json(result), settings.results, console);
    write_tables(result, settings.results.folder, console);
    console.note(fmt::format("{} in {} s{}", counted(result.ride_count(), "ride"),
                             number_text(result.wall_seconds),
                             result.kept ? fmt::format("; {} kept from before", result.kept) : ""));

    // One ride that stayed finite makes the sweep usable.
    for (const auto& rides : result.rides)
      for (const RideMeasures& ride : rides)
        if (!ride.has_diverged()) return kDone;
    console.error("every ride diverged");
    return kNotUsable;
  } catch (const Interrupted&) {
    console.note("every finished block of rides is kept in " + settings.results.folder +
                 "; the same command goes on from there");
    throw;
  }
}

std::vector<Option> options_of(SweepSettings& settings) {
  std::vector<Option> options{
      // The request, and what may stand in place of its numbers.
      {.names = "REQUEST",
       .target = &settings.request,
       .help = "the vehicle, the controllers and what varies: a YAML file, or one that comes with "
               "Dashpot: " +
               join(sweep_names(), ", "),
       .takes = Takes::File},
      {.names = "--samples",
       .target = &settings.samples,
       .help = "vehicles drawn; more than before go on where the last ones ended",
       .value = "N",
       .minimum = 1,
       .default_text = "the request's"},
      {.names = "--duration",
       .target = &settings.duration,
       .help = "duration of each ride, s",
       .value = "S",
       .minimum = 0.1,
       .default_text = "the request's"},
      {.names = "--seed",
       .target = &settings.seed,
       .help = "seed of all that is drawn",
       .value = "N",
       .minimum = 1,
       .default_text = "the request's"}};

  // A store of rides is thrown away by --fresh, not merely left aside.
  append(options, study_result_options(settings.results, "rides"));
  options.back().help =
      "start anew: the rides of an earlier sweep in DIR/sweep.sqlite are thrown away";

  append(options, {threads_option(settings.threads),
                   {.names = "--measures",
                    .target = &settings.measures,
                    .help = "list the measures of a ride"}});
  append(options, many_machines_options(settings.machines));
  return options;
}

}  // namespace

Command sweep_command() {
  auto settings = std::make_shared<SweepSettings>();
  return {
      .name = "sweep",
      .title = "Thousands of vehicles over roads: how far dampers can be trusted",
      .description =
          "Draws vehicles from the distributions of a request - masses, stiffnesses, dampers as "
          "built, speeds, roads - and drives each of them under every controller over the same "
          "road. Prints quantiles of comfort, road holding, travel and energy, the ratios to a "
          "baseline vehicle by vehicle, and which inputs matter; writes every ride as CSV and "
          "HDF5, and a page. Each block of rides is kept in DIR/sweep.sqlite as it ends: the same "
          "command goes on where it was stopped. The result does not depend on threads or "
          "interruptions.",

      .options = options_of(*settings),
      .example = std::string(kSweepExample),
      .run = [settings](Console& console) { return run_sweep(*settings, console); },
      .over_ranks = true};
}

}  // namespace dashpot::cli
