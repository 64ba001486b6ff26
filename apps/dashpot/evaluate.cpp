#include <algorithm>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/identify/fit/fit_words.h"
#include "dashpot/identify/judge/extrapolation.h"
#include "dashpot/rank.h"
#include "dashpot/report/interval_table.h"
#include "dashpot/report/report_json.h"
#include "data.h"
#include "layout.h"
#include "results.h"

namespace dashpot::cli {
namespace {

struct Settings {
  std::string model;
  DataSettings data;
  std::string force_offset = "record";
  std::string outside_family = "mark";
  std::string report;
  int threads = 0;
};

constexpr std::string_view kExample =
    "# How well does a model, fitted elsewhere, predict these recordings?\n"
    "dashpot evaluate results/models/tanh_kwok.json more-recordings/\n"
    "\n"
    "# The same figures for a script:\n"
    "dashpot evaluate results/models/tanh_kwok.json more-recordings/ --json | jq .pooled.rmse_N";

std::string percent(double value) { return fmt::format("{:.2f}", value); }

std::vector<std::string> record_row(const RecordResult& r) {
  const std::string level = r.drive_level ? format_number(*r.drive_level) : "varies";
  if (r.diverged_at)
    return {r.record, level, "", "",
            "",       "",    "", "diverged at " + format_number(*r.diverged_at) + " s"};
  const Metrics& m = r.metrics;
  return {r.record,       level,          format_number(m.rmse),   percent(m.rms_half_span),
          percent(m.esr), percent(m.fit), percent(r.energy_error), format_number(r.offset, 3)};
}

std::vector<std::string> pooled_row(const std::string& name, const Metrics& m) {
  return {name, "", format_number(m.rmse), percent(m.rms_half_span), percent(m.esr), percent(m.fit),
          "",   ""};
}

std::string record_table(const Evaluation& evaluation, DriveUnit drive_unit, int width) {
  Table table({"record", ">" + to_string(drive_unit), ">RMSE N", ">rms/half-span %", ">ESR %",
               ">fit %", ">energy error %", ">offset N"});
  for (const RecordResult& r : evaluation.records) table.row(record_row(r));
  if (evaluation.pooled.samples > 0) {
    table.row(pooled_row("all", evaluation.pooled));
    table.row(pooled_row("all, without offsets", evaluation.pooled_without_offset));
  }
  return table.text(static_cast<std::size_t>(width));
}

std::string band_table(const Evaluation& evaluation, int width) {
  Table table({"velocity band", ">|v| m/s", ">samples", ">RMSE N", ">MAE N", ">max |e| N"});
  for (const BandResult& band : evaluation.bands)
    table.row({band.name, format_number(band.low, 3) + " ... " + format_number(band.high, 3),
               std::to_string(band.metrics.samples), format_number(band.metrics.rmse),
               format_number(band.metrics.mae), format_number(band.metrics.max_error)});
  return table.text(static_cast<std::size_t>(width));
}

/// Of models that feed their force back.
std::string one_step_line(const Evaluation& evaluation) {
  if (!evaluation.one_step) return {};
  return "one step ahead, with the measured force fed back (flatters; no measure of the model): "
         "RMSE " +
         format_number(evaluation.one_step->rmse) + " N, ESR " + percent(evaluation.one_step->esr) +
         " %\n";
}

/// The report of `identify` with this model alone in it, fitted elsewhere.
void write_report(const Settings& settings, const Dataset& dataset, ModelFile file,
                  const Evaluation& evaluation, Console& console) {
  RankedModel ranked;
  ranked.name = file.model->name();
  ranked.title = settings.model;
  ranked.fit.status = FitReport::Status::Converged;
  ranked.fit.message = "not fitted here: read from " + settings.model;
  ranked.fit.model = std::move(file.model);
  ranked.band = std::move(file.interval);
  ranked.left_out = evaluation;
  for (RecordResult& r : ranked.left_out.records) r.left_out = true;
  Ranking ranking;
  ranking.folds = {"all records, none of them fitted"};
  ranking.models.push_back(std::move(ranked));
  write_file(settings.report, html_report(report_input(dataset, ranking, console)));
  console.print("\nReport  " + settings.report + '\n');
}

int run(const Settings& settings, Console& console) {
  ModelFile file = load_model(settings.model);
  if (const auto* family = model_as<FamilyModel>(*file.model);
      family && settings.outside_family == "refuse")
    file.model = family->with_outside(OutsideFamily::Refuse);
  const Dataset dataset = load_recordings(settings.data, console);
  require_same_drive(file, dataset, settings.model);
  const EvaluateOptions options{.offset = offset_mode(settings.force_offset, "--force-offset"),
                                .known_offsets = {},
                                .band = file.interval,
                                .threads = settings.threads};
  const Evaluation evaluation = evaluate(*file.model, dataset.records, dataset.drive_unit, options);
  console.check_stop();
  const std::vector<Extrapolation> outside = extrapolations(file, dataset);
  console.print('\n' + console.bold(file.model->name()) +
                " in free run, nothing fitted but the force zero of each record\n\n");
  console.print(record_table(evaluation, dataset.drive_unit, console.width()) +
                one_step_line(evaluation));
  if (evaluation.pooled.samples > 0) console.print('\n' + band_table(evaluation, console.width()));
  if (const std::string sentence = interval_sentence(evaluation); !sentence.empty())
    console.print('\n' + paragraph(sentence, static_cast<std::size_t>(console.width())));
  for (const Extrapolation& e : outside) console.warn(describe(e));
  for (const std::string& what : outside_family(evaluation))
    console.warn(what + ": it extrapolates there");
  if (console.json) console.print_json(evaluation_json(file, evaluation, outside));
  if (!settings.report.empty())
    write_report(settings, dataset, std::move(file), evaluation, console);
  if (evaluation.diverged == 0) return kDone;
  console.error(fmt::format("the model diverged on {} of {} records", evaluation.diverged,
                            evaluation.records.size()));
  return kNotUsable;
}

}  // namespace

Command evaluate_command() {
  auto settings = std::make_shared<Settings>();
  Command command{.name = "evaluate",
                  .title = "Judge a model file on recordings, without fitting",
                  .description =
                      "Runs a model in free run over each recording (motion and current in, force "
                      "out) and prints "
                      "its errors per record, pooled and by velocity. Says where the recordings "
                      "leave the range "
                      "that the model was fitted on.",
                  .options = {{.names = "MODEL",
                               .target = &settings->model,
                               .help = "a model file that 'dashpot identify' wrote",
                               .takes = Takes::File,
                               .required = true}},
                  .example = std::string(kExample),
                  .run = [settings](Console& console) { return run(*settings, console); }};
  append(command.options, data_options(settings->data));
  append(
      command.options,
      {{.names = "--outside-family",
        .target = &settings->outside_family,
        .help =
            "a damper outside the family that the model is of: tell of it and go on, or refuse it",
        .value = "MODE",
        .choices = {"mark", "refuse"}},
       {.names = "--force-offset",
        .target = &settings->force_offset,
        .help =
            "the force zero (gas, load cell): a free offset per record, or the model's own alone",
        .value = "MODE",
        .choices = {"record", "none"}},
       {.names = "--report",
        .target = &settings->report,
        .help = "also write a report page",
        .value = "FILE",
        .takes = Takes::File},
       threads_option(settings->threads)});
  return command;
}

}  // namespace dashpot::cli
