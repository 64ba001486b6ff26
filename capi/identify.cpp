#include <algorithm>

#include "dashpot/base/date.h"
#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/export/js/js.h"
#include "dashpot/identify/judge/traces.h"
#include "dashpot/identify/rank/model_choice.h"
#include "dashpot/rank.h"
#include "dashpot/report/report_json.h"
#include "handles.h"
#include "recordings.h"
#include "status.h"
#include "words.h"
#include "work.h"

using namespace dashpot;
using namespace dashpot::capi;

namespace {

std::string json_text(const Value& value) { return format_json(presentable(value)); }

/// The fitted model as a file that keeps where it comes from; it was judged on nothing.
ModelFile fitted_file(FitReport fit, const Dataset& dataset, const FitOptions& options) {
  RankedModel ranked;
  ranked.name = fit.model->name();
  ranked.fit = std::move(fit);
  ranked.training = evaluate(*ranked.fit.model, dataset.records, dataset.drive_unit,
                             {.offset = options.words.options.offset,
                              .known_offsets = ranked.fit.offsets,
                              .threads = options.words.options.threads});
  ModelFile file = to_model_file(ranked, dataset, options.command);
  file.provenance.created = date_now();
  file.quality = Value::object({{"training", to_json(ranked.training.pooled)}});
  return file;
}

/// The recordings that a model is judged on, with the forces that it was fitted to, and of how many
/// that meant taking the inertia off.
struct JudgedRecordings {
  Dataset dataset;
  std::size_t without_inertia = 0;
};
/// Throws Error where the model is driven in A and the recordings in V, or the other way round.
JudgedRecordings judged_recordings(const dashpot_model& model, const dashpot_recordings* recordings,
                                   const EvaluateWords& asked) {
  JudgedRecordings judged{.dataset = usable_dataset(recordings)};
  require_same_drive(model.file, judged.dataset, model.name);
  if (!asked.keep_inertia) judged.without_inertia = take_off_inertia(model.file, judged.dataset);
  return judged;
}

/// Fits the only model asked for. Throws NotUsable where the fit gives none; the report is there
/// even then.
void fit(const Dataset& dataset, FitOptions options, const dashpot_monitor* monitor,
         dashpot_model** model, char** report) {
  const std::vector<std::string> names = choose_models(options.words.models, dataset.records).names;
  if (names.size() != 1)
    throw Error(
        "options, models",
        "'" + join(options.words.models, ", ") + "' is " + std::to_string(names.size()) + " models",
        "one; dashpot_identify compares several");

  // The fit runs beside the caller's thread, which may cancel it.
  options.words.options = identify_options(options.words, names, "options, ");
  options.words.options.from = first_starts(options.words, names, dataset);
  FitReport fitted;
  run_watched(monitor, [&](const Monitor& watched) {
    options.words.options.monitor = watched;
    fitted = identify(names.front(), dataset.records, dataset.drive_unit, options.words.options);
  });

  // The report is written before a failed fit is refused, since it says why.
  options.words.options.monitor = {};
  if (report) *report = copy_text(json_text(fit_json(fitted)));
  if (!fitted.model) throw NotUsable(names.front(), fitted.message);
  *model = new dashpot_model(fitted_file(std::move(fitted), dataset, options));
}

Ranking rank_watched(Dataset& dataset, FitOptions& options, const dashpot_monitor* monitor) {
  const LeaveOut leave_out = options.leave_out ? *options.leave_out : default_leave_out(dataset);
  const ChosenModels models = choose_models(options.words, dataset, leave_out, "options, budget");
  for (const std::string& name : models.passed_over)
    if (std::ranges::find(options.words.models, name) != options.words.models.end())
      throw Error(name, "needs a displacement, which not every recording has",
                  "record it, or leave this model out");
  IdentifyOptions asked = identify_options(options.words, models.names, "options, ");
  asked.from = first_starts(options.words, models.names, dataset);
  Ranking ranking;
  run_watched(monitor, [&](const Monitor& watched) {
    asked.monitor = watched;
    ranking = options.keep_inertia ? rank(models.names, dataset, leave_out, asked)
                                   : rank_without_inertia(models.names, dataset, leave_out, asked);
  });
  ranking.budget = models.budget;
  return ranking;
}

std::string report_text(const dashpot_ranking& of, const std::string& format) {
  const ReportInput input{.dataset = of.dataset,
                          .ranking = of.ranking,
                          .command = of.command,
                          .version = dashpot_version(),
                          .date = of.date,
                          .program = [](const ModelFile& file) {
                            return js_program(exported_model(file), {.version = dashpot_version()});
                          }};

  // Forms for programs.
  if (format == "json") return json_text(json_report(input));
  if (format == "csv") return csv_report(input);

  // Forms for people, all of one document.
  if (format == "html") return html_document(ranking_document(input));
  if (format == "markdown") return markdown_document(ranking_document(input));
  if (format == "text") return document_text(ranking_document(input), 100);

  throw Error("format", "is '" + format + "'", "json, html, markdown, csv or text");
}

}  // namespace

dashpot_status dashpot_fit(const dashpot_recordings* recordings, const char* options,
                           const dashpot_monitor* monitor, dashpot_model** model, char** report) {
  return guarded([&] {
    if (report) *report = nullptr;
    require(model, "model");
    *model = nullptr;
    fit(usable_dataset(recordings), read_fit_options(options), monitor, model, report);
  });
}

dashpot_status dashpot_identify(const dashpot_recordings* recordings, const char* options,
                                const dashpot_monitor* monitor, dashpot_ranking** ranking) {
  return guarded([&] {
    require(ranking, "ranking");
    *ranking = nullptr;
    auto made = std::make_unique<dashpot_ranking>();
    made->dataset = usable_dataset(recordings);
    FitOptions asked = read_fit_options(options);
    made->ranking = rank_watched(made->dataset, asked, monitor);
    made->command = std::move(asked.command);
    made->date = date_now();
    *ranking = made.release();
  });
}

size_t dashpot_ranking_count(const dashpot_ranking* ranking) {
  return ranking ? ranking->ranking.models.size() : 0;
}

dashpot_status dashpot_ranking_model(const dashpot_ranking* ranking, size_t place,
                                     dashpot_model** model) {
  return guarded([&] {
    require(model, "model");
    *model = nullptr;
    require(ranking, "ranking");

    // A place beyond the ranking, or one whose fit failed, has no model.
    const std::vector<RankedModel>& models = ranking->ranking.models;
    if (place >= models.size())
      throw Error("place", "is " + std::to_string(place),
                  "there are " + std::to_string(models.size()));
    if (!models[place].fit.model) throw NotUsable(models[place].name, models[place].fit.message);

    // The file dates from the ranking, not from this call.
    ModelFile file = to_model_file(models[place], ranking->dataset, ranking->command);
    file.provenance.created = ranking->date;
    *model = new dashpot_model(std::move(file));
  });
}

dashpot_status dashpot_ranking_report(const dashpot_ranking* ranking, const char* format,
                                      char** text) {
  return guarded([&] {
    require(text, "text");
    *text = nullptr;
    require(ranking, "ranking");
    require(format, "format");
    *text = copy_text(report_text(*ranking, format));
  });
}

void dashpot_ranking_free(dashpot_ranking** ranking) { give_back(ranking); }

dashpot_status dashpot_traces(const dashpot_model* model, const dashpot_recordings* recordings,
                              const char* options, dashpot_recordings** made) {
  return guarded([&] {
    require(made, "made");
    *made = nullptr;
    require(model, "model");
    const EvaluateWords asked = read_evaluate_options(options);
    const Dataset dataset = judged_recordings(*model, recordings, asked).dataset;
    const Evaluation evaluation =
        evaluate(*model->damper, dataset.records, dataset.drive_unit, asked.options);

    // They come even where the model diverged, and show how.
    auto forces = std::make_unique<dashpot_recordings>();
    forces->dataset.name = dataset.name;
    forces->dataset.drive_unit = dataset.drive_unit;
    forces->dataset.records = traces(evaluation.records, dataset.drive_unit);
    *made = forces.release();
    if (evaluation.diverged > 0)
      throw NotUsable(model->name, "diverged on " + std::to_string(evaluation.diverged) + " of " +
                                       counted(evaluation.records.size(), "recording"));
  });
}

dashpot_status dashpot_evaluate(const dashpot_model* model, const dashpot_recordings* recordings,
                                const char* options, char** report) {
  return guarded([&] {
    require(report, "report");
    *report = nullptr;
    require(model, "model");

    // The model runs over every recording with the band that its file keeps.
    EvaluateWords asked = read_evaluate_options(options);
    asked.options.band = model->file.interval;
    const JudgedRecordings judged = judged_recordings(*model, recordings, asked);
    const Dataset& dataset = judged.dataset;
    const Evaluation evaluation =
        evaluate(*model->damper, dataset.records, dataset.drive_unit, asked.options);

    // The report comes even where the model diverged, as it says on which recordings.
    Value told = evaluation_json(model->file, evaluation, extrapolations(model->file, dataset),
                                 judged.without_inertia);
    told.add("records_seen", seen_records(model->file.provenance, dataset));
    *report = copy_text(json_text(told));

    if (evaluation.diverged > 0)
      throw NotUsable(model->name, "diverged on " + std::to_string(evaluation.diverged) + " of " +
                                       counted(evaluation.records.size(), "recording"));
  });
}
