#include <algorithm>
#include <array>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/base/ranks.h"
#include "dashpot/base/text.h"
#include "dashpot/identify/many/many.h"
#include "dashpot/report/many_document.h"
#include "dashpot/report/words.h"
#include "data.h"
#include "identify_options.h"
#include "many_machines.h"
#include "results.h"
#include "speeds.h"
#include "study_results.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

struct ManySettings {
  std::string folder;
  DataSettings data;
  FitSettings fit;
  StudyResults results = {.folder = "dashpot-production"};
  std::string speeds;
  std::uint64_t pilot = ManyOptions().pilot;
  double false_alarms = ManyOptions().false_alarms;
  ManyMachines machines;
};

constexpr std::string_view kManyExample =
    "# A virtual production line of 300 dampers, one in fifty of them faulty, and what stands "
    "out:\n"
    "dashpot bench --dampers 300 --damper vrths_mr_tanh_kwok --motions 10x2,10x4 \\\n"
    "    --levels 0,1 --cycles 2 --sample-rate 200 --output line\n"
    "dashpot identify-many line --models tanh_kwok --output night\n"
    "\n"
    "# Interrupted, or more dampers since? The same command goes on. In parts:\n"
    "dashpot identify-many line --models tanh_kwok --part 1/2 --output part1\n"
    "dashpot identify-many line --models tanh_kwok --part 2/2 --output part2\n"
    "dashpot merge part1 part2 --output night";

ManyOptions many_options(const ManySettings& settings, Console& console) {
  ManyOptions options;
  options.models = settings.fit.models;
  for (const std::string& model : options.models)
    if (model == "usual" || model == "all" || model == "family")
      throw UsageError("--models", "'" + model + "' stands for many models",
                       "name one, or a few, for all dampers");
  options.fit = identify_options(settings.fit, options.models, console);
  options.load = settings.data.load;
  options.speeds = parse_speeds(settings.speeds);
  options.pilot = settings.pilot;
  options.false_alarms = settings.false_alarms;
  if (!(options.false_alarms > 0 && options.false_alarms < 0.5))
    throw UsageError("--false-alarms", "must lie between 0 and 0.5", "0.001 is one of 1000");
  return options;
}

/// CPU seconds of the fits of a damper, from the pilot's start and from all starts.
std::string cost_line(const ManyReport& report) {
  double warm = 0;
  for (const DamperRow& row : report.rows) warm += row.seconds;
  std::string text =
      fmt::format("{} in {} s{}; {} ms of CPU time each", counted(report.rows.size(), "damper"),
                  number_text(report.wall_seconds),
                  report.kept ? fmt::format(" ({} kept from before)", report.kept) : "",
                  number_text(1000 * warm / static_cast<double>(report.rows.size())));
  if (report.options.pilot > 0)
    text += fmt::format(
        ", from all starts {} ms ({} of the pilot)",
        number_text(1000 * report.pilot_seconds / static_cast<double>(report.pilot_fits)),
        report.pilot_fits);
  return text;
}

int tell_many(const ManyReport& report, const ManySettings& settings, Console& console) {
  const fs::path folder = settings.results.folder;
  const ColumnTable table = many_table(report);
  write_file(folder / "dampers.csv", csv_table(table));
  write_study(many_document(report), many_json(report), settings.results, console);
  console.print("Dampers  " + (folder / "dampers.csv").string() + '\n');
  console.note(cost_line(report));
  for (const DamperRow& row : report.rows) console.files_unread |= row.is_unread;
  if (report.fitted() > 0) return kDone;
  console.error("no damper has a result; the table says why");
  return kNotUsable;
}

int run_many(const ManySettings& settings, Console& console) {
  const Part part = settle_machines(settings.machines);
  const ManyOptions options = many_options(settings, console);
  const DamperFolders folders = find_dampers(settings.folder);
  prepare_study(settings.results);
  console.talk(fmt::format("{} in {}, in the order of {}\n",
                           counted(folders.names.size(), "damper"), settings.folder,
                           folders.has_serials ? "their serial numbers" : "their names"));
  if (!folders.passed_over.empty())
    console.note(fmt::format("passed over, since dampers are the folders there: {}",
                             counted(folders.passed_over.size(), "file")));

  // Every finished damper is kept as it ends.
  const fs::path file = fs::path(settings.results.folder) / "production.sqlite";
  if (settings.results.fresh) Store::remove(file);
  try {
    Store store(file, kManyFormat, describe_many(options, program_id()));
    tell_dropped(store.dropped(), file, console);
    // A worker of mpirun makes dampers and leaves; rank 0 goes on to judge them.
    if (!part.is_all() || ranks().is_worker()) {
      const PartReport made = identify_many_part(folders, options, store, part);
      return ranks().is_worker() ? static_cast<int>(kDone)
                                 : finish_part(made, part, "damper", file, console);
    }
    return tell_many(identify_many(folders, options, store), settings, console);
  } catch (const Interrupted&) {
    console.note("every finished damper is kept in " + settings.results.folder +
                 "; the same command goes on from there");
    throw;
  }
}

}  // namespace

Command identify_many_command() {
  auto settings = std::make_shared<ManySettings>();
  settings->fit.models = {"tanh_kwok"};
  Command command{
      .name = "identify-many",
      .title = "A night of production: each damper fitted, and judged against all",
      .description =
          "Fits the same model, or a few, to each of many dampers: the subfolders of FOLDER, each "
          "with the recordings of one damper, or its files where it has no subfolders. Names the "
          "dampers that stand out in a parameter or in the force at a speed, the quantities that "
          "drift over the serial number, and the dampers without a result, with the reason. Each "
          "damper is kept in DIR/production.sqlite as it ends: the same command goes on where it "
          "was stopped, and with dampers that have come since. The result does not depend on "
          "threads, order or interruptions. docs/many.md has the rules.",
      .options = {{.names = "FOLDER",
                   .target = &settings->folder,
                   .help = "the folder of the dampers",
                   .takes = Takes::Folder,
                   .required = true}},
      .example = std::string(kManyExample),
      .run = [settings](Console& console) { return run_many(*settings, console); }};

  // What is known of recordings and fits, but for their own place and what tells of one dataset.
  std::vector<Option> data = data_options(settings->data);
  std::erase_if(data, [](const Option& option) {
    return option.names == "DATA" || option.long_name() == "--verbose";
  });
  append(command.options, data);
  append(
      command.options,
      {{.names = "--pilot",
        .target = &settings->pilot,
        .help = "dampers, the first ones, that are fitted from all starts; one of them is the "
                "start of every other fit. 0: all are fitted from all starts",
        .value = "N",
        .minimum = 0},
       {.names = "--false-alarms",
        .target = &settings->false_alarms,
        .help = "share of sound dampers that may be named by chance, where quantities are normal",
        .value = "SHARE",
        .minimum = 0},
       speeds_option(settings->speeds)});
  // A night has one recipe: what looks at a single damper closely is left to 'identify'.
  constexpr std::array kOfOneDamper{"--free",       "--bounds", "--prior",  "--allow-active",
                                    "--asymmetric", "--search", "--network"};
  std::vector<Option> fit = fit_options(settings->fit);
  std::erase_if(fit, [&](const Option& option) {
    return std::ranges::find(kOfOneDamper, option.long_name()) != kOfOneDamper.end();
  });
  for (Option& option : fit)
    if (option.long_name() == "--models")
      option.help =
          "the model to fit, or a few, separated by commas: of those that 'dashpot "
          "models' lists";
  append(command.options, fit);
  append(command.options, study_result_options(settings->results, "dampers"));
  command.options.back().help =
      "start anew: the dampers of an earlier run in DIR/production.sqlite are thrown away";
  append(command.options, many_machines_options(settings->machines));
  command.over_ranks = true;
  return command;
}

}  // namespace dashpot::cli
