#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/identify/fit/fit_words.h"
#include "dashpot/identify/judge/extrapolation.h"
#include "dashpot/rank.h"
#include "dashpot/report/report_json.h"
#include "data.h"
#include "document_text.h"
#include "evaluate_in_plant.h"
#include "results.h"
#include "traces.h"
#include "units.h"

namespace dashpot::cli {
namespace {

struct EvaluateSettings {
  std::string model, plant;
  DataSettings data;
  std::string force_offset = "record";
  std::string outside_family = "mark";
  bool keep_inertia = false;
  std::string report;
  std::string traces, units;
  std::string folder = "dashpot-traces";
  int threads = 0;
};

constexpr std::string_view kEvaluateExample =
    "# How well does a model, fitted elsewhere, predict these recordings?\n"
    "dashpot evaluate results/models/tanh_kwok.json more-recordings/\n"
    "\n"
    "# The same figures for a script:\n"
    "dashpot evaluate results/models/tanh_kwok.json more-recordings/ --json | jq .pooled.rmse_N\n"
    "\n"
    "# A damper and its car, as 'identify --in' found them, on other rides:\n"
    "dashpot evaluate results/models/tanh_kwok.json rides/ --in results/plants/tanh_kwok.json";

/// A ranking of this model alone, fitted elsewhere.
Ranking as_ranking(const std::string& name, ModelFile file, const Dataset& dataset,
                   const Evaluation& evaluation) {
  RankedModel ranked;
  ranked.name = file.model->name();
  ranked.title = name;
  ranked.fit.status = FitReport::Status::Converged;
  ranked.fit.message = "not fitted here: read from " + name;
  ranked.dissipation = dissipation_of(file);
  ranked.fit.model = std::move(file.model);
  ranked.band = std::move(file.interval);
  ranked.left_out = evaluation;
  for (RecordResult& r : ranked.left_out.records) r.left_out = true;

  // What its fit has seen is no judgement.
  Ranking ranking;
  ranking.seen = seen_records(file.provenance, dataset);
  ranking.folds = {"all records, nothing fitted"};
  ranking.models.push_back(std::move(ranked));
  return ranking;
}

/// Which numbers of the damper that stands in a family's file are taken, where records state none.
void say_assumed_damper(const FamilyMember& own, const Dataset& dataset, Console& console) {
  // Each number that a record lacks, once; and how many records lack any.
  std::vector<std::string> assumed;
  std::size_t records = 0;
  for (const Record& record : dataset.records) {
    bool lacks = false;
    for (const MemberField& field : member_fields()) {
      if (!field.required || find_condition(record.conditions, field.name)) continue;
      lacks = true;
      const std::string words = std::string(field.name) + ' ' + format_number(own.*field.field) +
                                ' ' + std::string(field.unit);
      if (std::ranges::find(assumed, words) == assumed.end()) assumed.push_back(words);
    }
    records += lacks;
  }

  if (records > 0)
    console.note(
        fmt::format("the damper is not stated in full by {} of {}: taken from the model's "
                    "file: {}",
                    records, counted(dataset.records.size(), "record"), join(assumed, ", ")));
}

int run_evaluate(const EvaluateSettings& settings, Console& console) {
  if (!settings.plant.empty())
    return run_evaluate_in_plant({.model = settings.model,
                                  .plant = settings.plant,
                                  .recordings = settings.data.paths,
                                  .report = settings.report,
                                  .traces = settings.traces,
                                  .units = settings.units,
                                  .folder = settings.folder,
                                  .threads = settings.threads},
                                 console);
  require_page(settings.report);
  const PrintUnits csv_units = file_units(settings.units);
  ModelFile file = load_model(settings.model);
  if (const auto* family = model_as<FamilyModel>(*file.model);
      family && settings.outside_family == "refuse")
    file.model = family->with_outside(OutsideFamily::Refuse);

  // The recordings must be driven in the unit that the model takes.
  Dataset dataset = load_recordings(settings.data, console);
  require_same_drive(file, dataset, settings.model);
  if (const auto* family = model_as<FamilyModel>(*file.model))
    say_assumed_damper(family->member(), dataset, console);
  const std::size_t changed = settings.keep_inertia ? 0 : take_off_inertia(file, dataset);
  if (changed > 0)
    console.note("the model was fitted to forces without the inertia of " +
                 format_number(file.moving_mass, 3) +
                 " kg between load cell and damper: it is taken off " + std::to_string(changed) +
                 " of " + counted(dataset.records.size(), "record") +
                 " here, too (not so with --keep-inertia)");

  // Its errors, and where it extrapolates.
  const EvaluateOptions options{.offset = offset_mode(settings.force_offset, "--force-offset"),
                                .known_offsets = {},
                                .band = file.interval,
                                .threads = settings.threads};
  const Evaluation evaluation = evaluate(*file.model, dataset.records, dataset.drive_unit, options);
  console.check_stop();
  const std::vector<Extrapolation> outside = extrapolations(file, dataset);
  Value data = evaluation_json(file, evaluation, outside, changed);
  data.add("records_seen", seen_records(file.provenance, dataset));
  Ranking ranking = as_ranking(settings.model, std::move(file), dataset, evaluation);

  // What is to be said beside these errors stands on the page as well.
  RankedModel& model = ranking.models.front();
  std::vector<std::string> warnings;
  for (const Extrapolation& e : outside) warnings.push_back(describe(e));
  if (const std::string active = activity(model.dissipation, dataset.drive_unit); !active.empty())
    warnings.push_back("beyond these recordings: " + active);
  if (const std::size_t seen = *ranking.seen; seen > 0)
    warnings.push_back(
        fmt::format("the fit of the model has seen {} of {}: these errors are no judgement", seen,
                    counted(dataset.records.size(), "record")));
  for (const std::string& what : outside_family(evaluation))
    warnings.push_back(what + ": it extrapolates there");
  model.fit.warnings = warnings;

  // The result on the terminal, as a page, and the traces of each record.
  Document document = evaluation_document(report_input(dataset, ranking, settings.units, console));
  document.data = std::move(data);
  const bool is_infinite = evaluation.diverged == 0 && !std::isfinite(evaluation.pooled.rmse);
  if (is_infinite)
    document.verdict =
        "The error is not finite: nothing below can be used. Are the model and the "
        "recordings of the same damper, in the same units?";
  print_document(document, console);
  for (const std::string& warning : warnings) console.warn(warning);
  if (console.json) console.print_json(document_json(document));
  if (!settings.report.empty()) {
    write_page(document, settings.report);
    console.print("\nReport  " + settings.report + '\n');
  }
  if (!settings.traces.empty()) {
    const std::size_t written = write_traces(evaluation.records, dataset.drive_unit,
                                             settings.traces, csv_units, settings.folder);
    console.print(fmt::format("\nTraces  {}/ ({})\n", settings.folder,
                              counted(written, settings.traces == "raw" ? "record" : "file")));
  }
  if (is_infinite) return kNotUsable;
  if (evaluation.diverged == 0) return kDone;
  console.error(fmt::format("the model diverged on {} of {} records", evaluation.diverged,
                            evaluation.records.size()));
  return kNotUsable;
}

}  // namespace

Command evaluate_command() {
  auto settings = std::make_shared<EvaluateSettings>();
  Command command{.name = "evaluate",
                  .title = "Judge a model file on recordings, without fitting",
                  .description =
                      "Runs a model in free run over each recording (motion and current in, force "
                      "out) and prints its errors per record, pooled and by velocity. Says where "
                      "the recordings leave the range that the model was fitted on. With --in, the "
                      "whole plant in free run: its inputs in, what its sensors show out.",
                  .options = {{.names = "MODEL",
                               .target = &settings->model,
                               .help = "a model file that 'dashpot identify' wrote; with --in, of "
                                       "several dampers one for all, or one each by the names of "
                                       "their struts: front=a.json,rear=b.json",
                               .takes = Takes::File,
                               .required = true}},
                  .example = std::string(kEvaluateExample),
                  .run = [settings](Console& console) { return run_evaluate(*settings, console); },
                  .likewise = {"validate", "predict", "test"}};

  append(command.options, data_options(settings->data));
  command.options.push_back(
      {.names = "--in",
       .target = &settings->plant,
       .help = "DATA are of a plant in which the damper works: the plant with all its numbers "
               "known, and its sensors, as a YAML file or words (docs/in-plant.md); 'identify "
               "--in' writes what it found into plants/",
       .value = "PLANT",
       .takes = Takes::File,
       .default_text = "a bench that measures the damper's force",
       .idles = {{{"--dataset", "--no-recognise"}, "", "the plant says which channel is which"},
                 {{"--velocity-cutoff", "--verbose", "--outside-family", "--force-offset",
                   "--keep-inertia"},
                  "",
                  "leave it out: no force is measured"}}});

  // The limits of the model's family, and the treatment of the force zero.
  append(
      command.options,
      {{.names = "--outside-family",
        .target = &settings->outside_family,
        .help = "a damper outside the family of the model: warn and go on, or refuse it",
        .value = "MODE",
        .choices = {"mark", "refuse"}},
       {.names = "--force-offset",
        .target = &settings->force_offset,
        .help =
            "the force zero (gas, load cell): a free offset per record, or the model's own alone",
        .value = "MODE",
        .choices = {"record", "none"}},
       {.names = "--keep-inertia",
        .target = &settings->keep_inertia,
        .help = "leave the force as it was recorded where the model was fitted to forces that "
                "were freed of the inertia between load cell and damper"},

       units_option(settings->units),
       {.names = "--report",
        .target = &settings->report,
        .help = "also write a report page, printed where FILE ends in .pdf",
        .value = "FILE",
        .takes = Takes::File},
       traces_option(settings->traces),
       {.names = "-o,--output",
        .target = &settings->folder,
        .help = "folder of the traces",
        .value = "DIR",
        .takes = Takes::Folder,
        .needs = "--traces"},
       threads_option(settings->threads)});
  return command;
}

}  // namespace dashpot::cli
