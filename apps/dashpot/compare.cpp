#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/identify/judge/extrapolation.h"
#include "dashpot/rank.h"
#include "dashpot/report/comparison_document.h"
#include "dashpot/report/words.h"
#include "data.h"
#include "document_text.h"
#include "results.h"
#include "speeds.h"

namespace dashpot::cli {
namespace {

struct CompareSettings {
  std::vector<std::string> things;
  std::string speeds, report;
  double cutoff_hz = 0;
  int threads = 0;
};

constexpr std::string_view kCompareExample =
    "# What has changed since the last campaign, at the same speeds and currents?\n"
    "dashpot compare before/ after/ --report changes.html\n"
    "\n"
    "# Two models over recordings that neither has seen:\n"
    "dashpot compare new-recordings/ results/models/tanh_kwok.json results/models/anfis.json\n"
    "\n"
    "# Two models alone, on sines over the range that both know:\n"
    "dashpot compare old.json new.json";

bool is_model_file(const std::string& path) {
  if (!path.ends_with(".json") || !std::filesystem::is_regular_file(path)) return false;
  return read_file(path).find("\"dashpot-model\"") != std::string::npos;
}

/// Sines for models that are compared without recordings: the stroke of the first one's data, at
/// speeds up to its greatest, at the least, the middle and the greatest drive of its data.
Dataset sines_for(const ModelFile& file) {
  constexpr int kSpeeds = 12;
  constexpr double kSlowest = 0.02;
  const Domain& d = file.domain;
  const double amplitude = (d.displacement_max - d.displacement_min) / 2,
               fastest = std::max(std::abs(d.velocity_min), std::abs(d.velocity_max));
  if (!(amplitude > 0 && std::isfinite(amplitude) && fastest > 0 && std::isfinite(fastest)))
    throw Error("compare", "the first model does not say which motion it is for",
                "recordings before it, which it is then run over");

  // A bench without noise, at the drives of the data.
  BenchOptions bench{.motions = {},
                     .drive_levels = {d.current_min},
                     .force_noise = 0,
                     .displacement_noise = 0,
                     .velocity_sensor = true,
                     .force_resolution = 0,
                     .displacement_resolution = 0,
                     .force_offset = 0};
  if (d.current_max > d.current_min) {
    bench.drive_levels.push_back((d.current_min + d.current_max) / 2);
    bench.drive_levels.push_back(d.current_max);
  }

  // The amplitude stays, the frequency gives the speed.
  for (int k = 0; k < kSpeeds; ++k) {
    const double speed = fastest * std::pow(kSlowest, 1 - k / (kSpeeds - 1.0));
    bench.motions.push_back({amplitude, speed / (2 * std::numbers::pi * amplitude)});
  }

  bench.sample_rate = std::max(500.0, 200 * bench.motions.back().frequency);
  Dataset dataset = run_virtual_bench(*file.model, file.drive_unit, bench);
  dataset.name = "sines";
  return dataset;
}

/// The recordings with a model's force in place of the measured one.
ComparedThing run_model(const std::string& path, const Dataset& dataset, bool is_measured,
                        int threads) {
  const ModelFile file = load_model(path);
  require_same_drive(file, dataset, path);

  // Recordings have an offset of the load cell each; sines of the bench have none.
  ComparedThing thing{.name = path, .dataset = dataset, .is_model = true};
  Evaluation evaluation = evaluate(*file.model, dataset.records, dataset.drive_unit,
                                   {.offset = is_measured ? OffsetMode::Record : OffsetMode::None,
                                    .known_offsets = {},
                                    .threads = threads});

  for (std::size_t r = 0; r < dataset.records.size(); ++r) {
    Record& record = thing.dataset.records[r];
    const RecordResult& result = evaluation.records[r];
    if (result.diverged_at)
      throw Error(path, "diverged on record '" + result.record + "' and cannot be compared",
                  "a model that stays finite; dashpot physics shows where it does not");
    record.find("force")->samples = result.modelled;
  }

  if (is_measured) {
    thing.seen = seen_records(file.provenance, dataset);
    thing.evaluation = std::move(evaluation);
  }
  return thing;
}

/// Short names where they stay apart: a model file's without folder and ending.
void shorten_names(std::vector<ComparedThing>& things) {
  std::vector<std::string> names;
  for (const ComparedThing& thing : things)
    names.push_back(thing.is_model ? std::filesystem::path(thing.name).stem().string()
                                   : thing.name);
  for (std::size_t k = 0; k < things.size(); ++k)
    if (std::ranges::count(names, names[k]) == 1) things[k].name = names[k];
}

/// Everything, characterised: recordings first as they are read, then models over the first of
/// them, or over sines where there are none; in the order of the command line.
std::vector<ComparedThing> gather(const CompareSettings& settings, Console& console) {
  std::vector<bool> is_model;
  for (const std::string& thing : settings.things) is_model.push_back(is_model_file(thing));
  std::vector<ComparedThing> things(settings.things.size());
  const Dataset* motion = nullptr;
  for (std::size_t k = 0; k < things.size(); ++k) {
    if (is_model[k]) continue;
    DataSettings data;
    data.paths = {settings.things[k]};
    data.load.velocity_cutoff_hz = settings.cutoff_hz;
    things[k] = {.name = settings.things[k], .dataset = load_recordings(data, console)};
    if (!motion) motion = &things[k].dataset;
    if (things[k].dataset.drive_unit != motion->drive_unit)
      throw Error(settings.things[k],
                  "is driven in " + name_of(things[k].dataset.drive_unit) + ", the others in " +
                      name_of(motion->drive_unit),
                  "recordings with the same drive");
  }

  // Models follow the first recordings.
  Dataset sines;
  const bool is_measured = motion != nullptr;
  if (!motion) {
    sines = sines_for(load_model(settings.things.front()));
    motion = &sines;
  }
  for (std::size_t k = 0; k < things.size(); ++k) {
    if (is_model[k])
      things[k] = run_model(settings.things[k], *motion, is_measured, settings.threads);
    things[k].figures = characterise(things[k].dataset, {parse_speeds(settings.speeds)});
    console.check_stop();
  }
  shorten_names(things);
  return things;
}

int run_compare(const CompareSettings& settings, Console& console) {
  if (settings.things.size() < 2)
    throw UsageError("compare", "one thing cannot be compared",
                     "two or more model files and recordings: dashpot compare before/ after/");

  const std::vector<double> speeds = parse_speeds(settings.speeds);
  const std::vector<ComparedThing> things = gather(settings, console);
  const Document document =
      comparison_document({things, speeds, console.command_line(), DASHPOT_VERSION, date_now()});
  print_document(document, console);

  // A model that has seen the recordings is not judged by them.
  for (const ComparedThing& thing : things)
    if (thing.seen > 0)
      console.warn(fmt::format("{} was taught by {} of the recordings: this is no judgement",
                               thing.name, counted(thing.seen, "record")));

  if (console.json) console.print_json(document_json(document));
  if (!settings.report.empty()) {
    write_file(settings.report, html_document(document));
    console.print("\nReport  " + settings.report + '\n');
  }
  return kDone;
}

}  // namespace

Command compare_command() {
  auto settings = std::make_shared<CompareSettings>();
  return {.name = "compare",
          .title = "Lay models and recordings over each other",
          .description =
              "Compares the first of the things named with each of the others: forces at the same "
              "speeds and drives, knee, friction, yield and gas force, each difference beside its "
              "noise. Models are run over the first recordings, or, where there are none, over "
              "sines within their data. Warns where a recording taught a model.",
          .options = {{.names = "THINGS",
                       .target = &settings->things,
                       .help = "two or more: model files, and recordings (files, folders or "
                               "dataset files)",
                       .takes = Takes::File,
                       .required = true},
                      speeds_option(settings->speeds),
                      {.names = "--velocity-cutoff",
                       .target = &settings->cutoff_hz,
                       .help = "cut-off frequency of the zero-phase filter that velocity is "
                               "derived with",
                       .value = "HZ",
                       .minimum = 0,
                       .default_text = "from the motion, and stated"},
                      {.names = "--report",
                       .target = &settings->report,
                       .help = "also write a page with the curves laid over each other",
                       .value = "FILE",
                       .takes = Takes::File},
                      threads_option(settings->threads)},
          .example = std::string(kCompareExample),
          .run = [settings](Console& console) { return run_compare(*settings, console); }};
}

}  // namespace dashpot::cli
