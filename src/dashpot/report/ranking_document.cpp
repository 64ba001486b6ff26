#include <algorithm>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/mean/mean_model.h"
#include "dashpot/identify/judge/left_inertia.h"
#include "dashpot/report/predicted_ride_section.h"
#include "dashpot/report/provenance.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/ranking_figures.h"
#include "dashpot/report/ranking_tables.h"
#include "dashpot/report/ranking_words.h"
#include "dashpot/report/report.h"
#include "dashpot/report/residual_section.h"
#include "dashpot/report/slider_section.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

constexpr std::string_view kLegend =
    "Free run on left-out records. ESR: share of the force's power left unexplained, over all "
    "samples; Mean, Worst: by record; Train: on the records of the fit. Slow: RMS error below 5 % "
    "of the top speed. Energy: of the dissipated energy, by record. Par.: fitted numbers. Fit: CPU "
    "time of all fits. Bounded: the force stays within ten spans at twice the stroke and speed of "
    "the data. x first: how many times the first model's ESR its own is on a typical left-out "
    "unit, 90 % interval; Apart: whether it lies above 1. Forgets: runs from different states meet "
    "after so long.";

/// Whether the error that the best model leaves follows the acceleration.
std::vector<std::string> inertia_remarks(const Ranking& ranking) {
  if (ranking.models.empty()) return {};
  const RankedModel& best = ranking.models.front();
  const LeftInertia left = left_inertia(best.left_out);
  if (!left.is_told()) return {};
  return {fmt::format(
      "{} % of the squared error that {} leaves on left-out records follows the acceleration, as "
      "{} kg between load cell and damper would make it, or a hysteresis that the model lacks. "
      "Where there is such a mass, state it in a dataset file: force: {{..., moving_mass: {}}}.",
      number_text(100 * left.share, 2), display_name(best), number_text(left.mass, 2),
      number_text(left.mass, 2))};
}

/// Without the column of further recordings where there are none.
std::vector<ColumnChoice> chosen_columns(const Ranking& ranking,
                                         std::vector<ColumnChoice> columns) {
  if (ranking.validated_on.empty())
    std::erase_if(columns, [](const ColumnChoice& choice) {
      return choice.name == std::string_view("validation_esr_percent");
    });
  return columns;
}

/// Every column of the page; identify's own selection on a terminal.
DocumentSection ranking_section(const Ranking& ranking) {
  constexpr Audience kPage = Audience::Page, kText = Audience::Text;
  DocumentTable table =
      model_table(ranking, chosen_columns(ranking, {{"model", 0, kText},
                                                    {"title", 0, kPage},
                                                    {"esr_percent"},
                                                    {"over_first", 2},
                                                    {"told_apart"},
                                                    {"validation_esr_percent"},
                                                    {"rmse_N"},
                                                    {"fit_percent"},
                                                    {"r2", 6},
                                                    {"rms_half_span_percent", 4},
                                                    {"mean_esr_percent", 0, kPage},
                                                    {"worst_esr_percent"},
                                                    {"worst_record", 5, kText},
                                                    {"pre_yield_rmse_N", 0, kPage},
                                                    {"energy_error_percent", 0, kPage},
                                                    {"no_offset_esr_percent", 1},
                                                    {"training_esr_percent", 2},
                                                    {"coverage_percent", 0, kPage},
                                                    {"interval_width_N", 0, kPage},
                                                    {"parameters", 3},
                                                    {"nanoseconds_per_step", 7},
                                                    {"fit_cpu_seconds", 3},
                                                    {"largest_spans", 0, kPage},
                                                    {"forgets", 0, kPage},
                                                    {"dissipates", 1},
                                                    {"status"}}));

  // A click on a row shows the model below.
  table.leads_to = "closer";
  table.note = comparison_note(ranking).value_or("");
  if (const std::optional<std::string> one_step = one_step_note(ranking))
    table.note += (table.note.empty() ? "" : " ") + *one_step;
  std::vector<std::string> paragraphs;
  if (const std::optional<std::string> untried = budget_note(ranking))
    paragraphs.push_back(*untried);
  if (const std::optional<std::string> validated = validation_note(ranking))
    paragraphs.push_back(*validated);
  if (const std::optional<std::string> freed = inertia_note(ranking)) paragraphs.push_back(*freed);
  return {.name = "ranking",
          .title = ranking.seen ? "Errors" : "Ranking",
          .paragraphs = std::move(paragraphs),
          .tables = {std::move(table)},
          .remarks = inertia_remarks(ranking),
          .lead = ranking.seen
                      ? "Every figure is of " + judged_records(ranking) + ", in free run."
                      : "Best first. Every figure is of left-out records in free run unless its "
                        "column says otherwise; a click on a head sorts, a click on a row looks "
                        "closer."};
}

/// None where no model has an interval.
std::vector<DocumentSection> interval_sections(const Ranking& ranking) {
  DocumentTable table = interval_table(ranking);
  if (table.rows.empty()) return {};
  return {{.name = "intervals",
           .title = "Intervals of the force",
           .paragraphs = {},
           .tables = {std::move(table)},
           .audience = Audience::Text}};
}

std::string result_text(const RankedModel& model, const RecordResult& result) {
  if (result.diverged_at)
    return fmt::format("{} diverged at {} s.", display_name(model),
                       number_text(*result.diverged_at));
  const Metrics& m = result.metrics;
  return fmt::format(
      "{}: ESR {} %, RMSE {} {}, fit {} %, greatest error {} {}, energy error {} %, offset {} {}.",
      display_name(model), percent_text(m.esr), quantity(m.rmse, "N"), unit_name("N"),
      percent_text(m.fit), quantity(m.max_error, "N"), unit_name("N"),
      percent_text(result.energy_error), quantity(result.offset, "N"), unit_name("N"));
}

/// One model on one record, as the reader of the page chooses.
DocumentSection closer_section(const ReportInput& input, std::vector<SharedSamples>& samples,
                               std::string& display, std::vector<DocumentSliders::Loop>& loops) {
  const Ranking& ranking = input.ranking;
  const std::vector<ShownRecord> records = shown_records(ranking);
  DocumentChoice model{"model", "Model", {}}, record{"record", "Record", {}};
  for (const ShownRecord& one : records) record.options.push_back(one.label());
  DocumentSection section{.name = "closer",
                          .title = "A closer look",
                          .paragraphs = {},
                          .lead = std::string("One model on one record") +
                                  (ranking.seen ? "" : ", left out unless it is marked") +
                                  "; the loops show all records of the same motion.",
                          .audience = Audience::Page};

  // A sentence for each model on each record.
  for (std::size_t m = 0; m < ranking.models.size(); ++m) {
    model.options.push_back(fmt::format("{}. {}", m + 1, display_name(ranking.models[m])));
    for (std::size_t r = 0; r < records.size(); ++r) {
      const RecordResult* result = records[r].of(ranking.models[m]);
      section.lists.push_back(
          {.title = {},
           .lines = {result ? result_text(ranking.models[m], *result)
                            : display_name(ranking.models[m]) + " was not judged on " +
                                  records[r].name + "."},
           .when = {{"model", {m}}, {"record", {r}}}});
    }
  }

  // The page opens with the best model on its worst record.
  const auto worst =
      std::ranges::find(records, ranking.models.front().left_out.worst_record, &ShownRecord::name);
  if (worst != records.end()) record.chosen = static_cast<std::size_t>(worst - records.begin());
  section.choices = {std::move(model), std::move(record)};
  section.figures = record_figures(input, samples, display, loops);
  for (DocumentFigure& figure : energy_figures(ranking))
    section.figures.push_back(std::move(figure));
  return section;
}

std::vector<std::string> warnings_of(const RankedModel& model,
                                     const std::vector<std::string>& folds) {
  const auto complaint = [](const FitReport& fit) {
    return fit.status == FitReport::Status::Failed ? "the fit failed: " + fit.message
                                                   : "the fit stopped at its iteration limit";
  };

  // The final fit, then those of the folds.
  std::vector<std::string> lines;
  if (model.fit.status != FitReport::Status::Converged) lines.push_back(complaint(model.fit));
  for (std::size_t k = 0; k < model.fold_fits.size(); ++k)
    if (model.fold_fits[k].status != FitReport::Status::Converged)
      lines.push_back((k < folds.size() ? folds[k] + ": " : "") + complaint(model.fold_fits[k]));
  lines.insert(lines.end(), model.fit.warnings.begin(), model.fit.warnings.end());
  return lines;
}

DocumentTable numbers_table(const RankedModel& model, When when) {
  DocumentTable table = parameter_table(model.fit);
  table.title = "Parameters of " + display_name(model) + ", with 95 % intervals";
  table.when = std::move(when);
  return table;
}

/// What a mean is made of, and on a terminal, which shows the first model alone, the numbers of the
/// best of its members that has some.
void add_members(const Ranking& ranking, const MeanModel& mean, const When& here,
                 DocumentSection& section) {
  DocumentTable members{"Members of the mean", {{"Model"}, {"Weight", true}}, {}};
  members.when = here;
  std::vector<std::string> names;
  for (const MeanModel::Member& member : mean.members()) {
    names.push_back(member.model->name());
    members.rows.push_back({names.back(), number_text(member.weight)});
  }
  section.tables.push_back(std::move(members));

  const auto best = std::ranges::find_if(ranking.models, [&](const RankedModel& model) {
    return !model.fit.parameters.empty() && std::ranges::find(names, model.name) != names.end();
  });
  if (best == ranking.models.end()) return;
  section.tables.push_back(numbers_table(*best, here));
  section.tables.back().audience = Audience::Terminal;
}

/// The final fit of each model, and its errors record by record; the latter alone of a model that
/// was fitted elsewhere.
DocumentSection fitted_section(const Ranking& ranking) {
  DocumentSection section{
      .name = "fitted",
      .title = ranking.seen ? "Record by record" : "Fitted on all training records",
      .paragraphs = {},
      .lead = ranking.seen
                  ? "Each record with its force offset."
                  : "The final fit of the chosen model, and each left-out record with its force "
                    "offset."};
  for (std::size_t m = 0; m < ranking.models.size(); ++m) {
    const RankedModel& model = ranking.models[m];
    const When here{{"model", {m}}};
    if (!model.fit.parameters.empty()) {
      section.tables.push_back(numbers_table(model, here));
    } else if (const auto* mean = dynamic_cast<const MeanModel*>(model.fit.model.get())) {
      add_members(ranking, *mean, here, section);
    } else if (model.fit.model && !ranking.seen) {
      section.lists.push_back({.title = {},
                               .lines = {display_name(model) + " is fitted as a whole: " +
                                         counted(model.fit.model->parameter_count(), "number") +
                                         " without a meaning of their own."},
                               .when = here,
                               .audience = Audience::Files});
    }

    // Errors record by record, and the warnings of its fits.
    section.tables.push_back(
        record_table(model.left_out, ranking.seen ? "Record" : "Left-out record"));
    section.tables.back().title = records_title(ranking) + ", " + display_name(model);
    section.tables.back().when = here;
    section.tables.back().audience = Audience::Files;
    if (!model.validation.records.empty()) {
      section.tables.push_back(record_table(model.validation, "Further record"));
      section.tables.back().title =
          "Further records, which no fit has seen, " + display_name(model);
      section.tables.back().when = here;
      section.tables.back().audience = Audience::Files;
    }
    section.lists.push_back({.title = "Warnings",
                             .lines = warnings_of(model, ranking.folds),
                             .when = here,
                             .audience = Audience::Files});
  }
  return section;
}

std::vector<KeyFigure> key_figures(const Ranking& ranking) {
  if (ranking.models.empty() || ranking.models.front().left_out.records.empty()) return {};
  const Evaluation& best = ranking.models.front().left_out;
  return {{percent_text(best.pooled.esr), "%", "of the force's power left unexplained (ESR)"},
          {quantity(best.pooled.rmse, "N"), unit_name("N"),
           "RMS error, free run, " + judged_records(ranking)},
          {percent_text(best.pooled.fit), "%", "fit: 100 (1 − √ESR)"},
          {percent_text(best.worst_esr), "%", "ESR of the worst record, " + best.worst_record}};
}

}  // namespace

Document ranking_document(const ReportInput& input) {
  const Ranking& ranking = input.ranking;
  Document document{.title = input.dataset.name,
                    .subtitle = counted(input.dataset.records.size(), "record") + " · " +
                                counted(ranking.models.size(), "model") + " · " +
                                protocol_title(ranking),
                    .verdict = verdict(ranking, input.dataset),
                    .sections = {},
                    .command = input.command,
                    .version = input.version,
                    .date = input.date,
                    .kind = "identification report",
                    .key_figures = key_figures(ranking),
                    .units = input.units,
                    .data = json_report(input)};

  // A ranking without models has only its protocol.
  std::string display;
  if (!ranking.models.empty()) {
    for (DocumentSection& section : predicted_ride_sections(ranking))
      document.sections.push_back(std::move(section));
    document.sections.push_back(ranking_section(ranking));
    for (DocumentSection& section : interval_sections(ranking))
      document.sections.push_back(std::move(section));
    std::vector<DocumentSliders::Loop> loops;
    document.sections.push_back(closer_section(input, document.samples, display, loops));
    if (std::optional<DocumentSection> sliders = slider_section(input, std::move(loops)))
      document.sections.push_back(std::move(*sliders));
    document.sections.push_back({.name = "overview",
                                 .title = "Across all records",
                                 .paragraphs = {},
                                 .tables = heat_maps(input),
                                 .figures = {overview_figure(input)},
                                 .lead = "Where the error lies: by motion, by drive and by speed.",
                                 .audience = Audience::Page});
    document.sections.push_back(fitted_section(ranking));
    if (DocumentSection section = residual_section(ranking); !section.tables.empty())
      document.sections.push_back(std::move(section));
  }
  document.sections.push_back(judged_section(protocol(ranking), ranking.folds, judged_terms()));
  document.provenance = provenance_section(input.dataset, display);
  return document;
}

Document leaderboard_document(const ReportInput& input) {
  const Ranking& ranking = input.ranking;
  Document document{.title = input.dataset.name,
                    .subtitle = {},
                    .verdict = verdict(ranking, input.dataset),
                    .sections = {},
                    .command = {},
                    .version = input.version,
                    .date = {},
                    .units = input.units};

  // How models were judged, and both tables.
  document.sections.push_back(
      {.name = "leaderboard",
       .title = "Leaderboard",
       .paragraphs = {"Left out: " + format_leave_out(ranking.leave_out) + ". " + protocol(ranking),
                      std::string(kLegend)},
       .tables = {model_table(ranking, {{"place"},
                                        {"model"},
                                        {"esr_percent"},
                                        {"over_first", 2},
                                        {"told_apart", 1},
                                        {"training_esr_percent"},
                                        {"mean_esr_percent", 1},
                                        {"worst_esr_percent", 1},
                                        {"pre_yield_rmse_N", 1},
                                        {"energy_error_percent", 2},
                                        {"parameters", 1},
                                        {"nanoseconds_per_step", 1},
                                        {"fit_cpu_seconds", 1},
                                        {"bounded", 1},
                                        {"forgets", 2},
                                        {"dissipates", 1},
                                        {"status"}}),
                  breakdown_table(ranking, input.dataset.drive_unit)}});
  for (auto sections : {predicted_ride_sections(ranking), interval_sections(ranking)})
    for (DocumentSection& section : sections) document.sections.push_back(std::move(section));

  if (const std::optional<std::string> untried = budget_note(ranking))
    document.sections.front().paragraphs.push_back(*untried);

  // Provenance is the citation alone: the part has neither command nor date.
  if (!input.dataset.citation.empty())
    document.provenance.facts.emplace_back("Data", input.dataset.citation);
  document.data = json_report(input);
  return document;
}

}  // namespace dashpot
