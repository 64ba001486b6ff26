#include "dashpot/report/ranking_tables.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/identify/judge/conformal.h"
#include "dashpot/identify/judge/stress.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/report/predicted_ride_section.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/ranking_words.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

/// A column of the ranking: its name for programs, how people see it, and a model's cell in it.
struct ModelColumn {
  std::string name;
  TextColumn look;
  std::function<DocumentCell(const RankedModel&)> cell;  ///< of a model; "place" needs none
};

std::string three_digits(double value) { return number_text(value, 3); }
std::string force(double value) { return quantity(value, "N"); }
std::string two_digits(double value) { return number_text(value, 2); }
std::string whole(double value) { return fmt::format("{:.0f}", value); }
std::string four_digits(double value) { return number_text(value, 4); }

std::string status_text(const RankedModel& model) {
  if (!model.fit.model || model.fit.status == FitReport::Status::Failed) return "fit failed";
  if (model.left_out.diverged) return fmt::format("{} diverged", model.left_out.diverged);
  if (!model.forgetting.is_forgotten()) return "remembers";
  if (!model.dissipation.dissipates()) return "feeds energy";
  return model.fit.status == FitReport::Status::IterationLimit ? "limit" : "";
}

/// A column of words.
template <typename Words>
ModelColumn words(const char* name, const char* title, const char* hint, Words text) {
  return {name, {.title = title, .hint = hint}, [=](const RankedModel& model) {
            return DocumentCell{text(model)};
          }};
}

/// A column of figures; a model that was not judged has none.
template <typename Figure>
ModelColumn figure(const char* name, const std::string& title, const char* hint, Figure value,
                   std::string (*text)(double), bool descending = false) {
  return {name,
          {.title = title, .numeric = true, .hint = hint, .descending = descending},
          [=](const RankedModel& model) {
            return is_judged(model) ? DocumentCell{text(value(model)), value(model)}
                                    : DocumentCell{"-", kNoNumber};
          }};
}

using Model = const RankedModel&;

double pre_yield_rmse(Model m) {
  return m.left_out.bands.empty() ? 0 : m.left_out.bands.front().metrics.rmse;
}

/// What was not measured, as of a model that was fitted elsewhere, is no zero.
double none_for_zero(double value) { return value > 0 ? value : kNoNumber; }

/// Every column that a table of models may have.
const std::vector<ModelColumn>& model_columns() {
  static const std::vector<ModelColumn> kColumns = [] {
    // Names first, then errors on left-out records, then the cost.
    std::vector<ModelColumn> all{
        {"place", {.title = "#", .numeric = true}, {}},
        words("model", "Model", "", [](Model m) { return m.name; }),
        words("title", "Model", "", [](Model m) { return display_name(m); }),
        figure(
            "esr_percent", "ESR %",
            "Error power over force power, left-out records, one offset per record",
            [](Model m) { return m.left_out.pooled.esr; }, percent_text),
        figure(
            "rmse_N", "RMSE " + unit_name("N"), "Root mean square error",
            [](Model m) { return m.left_out.pooled.rmse; }, force),
        figure(
            "fit_percent", "Fit %", "100 (1 - sqrt(ESR))",
            [](Model m) { return m.left_out.pooled.fit; }, percent_text, true),
        figure(
            "r2", "R2", "1 - ESR", [](Model m) { return m.left_out.pooled.r2; }, four_digits, true),
        figure(
            "rms_half_span_percent", "rms/half %", "200 RMSE / (Fmax - Fmin)",
            [](Model m) { return m.left_out.pooled.rms_half_span; }, percent_text),
        figure(
            "training_esr_percent", "Train %",
            "ESR of the final fit on the records that it was fitted on",
            [](Model m) { return m.training.pooled.samples ? m.training.pooled.esr : kNoNumber; },
            percent_text),
        figure(
            "mean_esr_percent", "Mean %", "Mean ESR over the left-out records",
            [](Model m) { return m.left_out.mean_esr; }, percent_text),
        figure(
            "worst_esr_percent", "Worst %",
            "ESR of the worst left-out record; a click on the row shows it",
            [](Model m) { return m.left_out.worst_esr; }, percent_text),
        words("worst_record", "Worst record", "", [](Model m) { return m.left_out.worst_record; }),
        figure(
            "validation_esr_percent", "Valid. %",
            "ESR of the final fit on the further recordings, which no fit has seen",
            [](Model m) {
              return m.validation.pooled.samples ? m.validation.pooled.esr : kNoNumber;
            },
            percent_text),
        figure("pre_yield_rmse_N", "Slow " + unit_name("N"),
               "RMS error in the band of least speed: the pre-yield region", pre_yield_rmse, force),
        figure(
            "energy_error_percent", "Energy %",
            "Error of the dissipated energy: mean of its magnitude over the records",
            [](Model m) { return m.left_out.mean_energy_error; }, percent_text),
        figure(
            "no_offset_esr_percent", "No offs. %",
            "ESR without the records' offsets: the model as it stands in its file",
            [](Model m) { return m.left_out.pooled_without_offset.esr; }, percent_text),
        figure(
            "coverage_percent", "Covered %",
            "Left-out samples inside the model's interval of the force, which claims 90 % and was "
            "made without them",
            [](Model m) { return m.left_out.coverage.percent(); }, percent_text),
        figure(
            "interval_width_N", "Width " + unit_name("N"), "Mean width of that interval",
            [](Model m) {
              return m.left_out.coverage.samples ? m.left_out.coverage.mean_width() : kNoNumber;
            },
            force),
        figure(
            "parameters", "Par.", "Fitted numbers of the model",
            [](Model m) { return static_cast<double>(m.fit.model->parameter_count()); }, whole),
        figure(
            "nanoseconds_per_step", "ns/step", "Time of one step on this machine",
            [](Model m) { return none_for_zero(m.nanoseconds_per_step); }, three_digits),
        figure(
            "fit_cpu_seconds", "Fit s", "CPU time of all folds and the final fit",
            [](Model m) { return none_for_zero(m.seconds); }, two_digits),
        words("status", "Status",
              "limit: the fit stopped at its iteration limit; diverged: on so many records; "
              "remembers: it does not forget how it began; feeds energy: into some motions; "
              "neither is recommended",
              status_text)};

    // Against the first model, sorted by the ratio itself.
    all.push_back({"over_first",
                   {.title = "x first",
                    .numeric = true,
                    .hint = "How many times the first model's ESR its own is on a typical left-out "
                            "unit: 90 % interval"},
                   [](Model m) {
                     return DocumentCell{over_first_text(m),
                                         m.over_first ? m.over_first->times : kNoNumber};
                   }});
    all.push_back(words("told_apart", "Apart",
                        "Whether the data show that the model is worse than the first one: that "
                        "interval lies above 1",
                        [](Model m) -> std::string {
                          return !m.over_first ? "-" : m.over_first->is_worse() ? "yes" : "no";
                        }));
    all.push_back({"forgets",
                   {.title = "Forgets",
                    .hint = "Time after which runs of one motion from different states are within "
                            "1 % of the force span for good; or no, and what is left between them"},
                   [](Model m) {
                     return DocumentCell{forgetting_text(m.forgetting),
                                         m.forgetting.is_tested ? m.forgetting.seconds : kNoNumber};
                   }});

    all.push_back({"dissipates",
                   {.title = "Dissipates",
                    .hint = "Whether it took energy out of all sines that were tried, from 1 to "
                            "200 Hz and from 0.1 um to the strokes and speeds of the data; or the "
                            "band in which it feeds some in"},
                   [](Model m) {
                     return DocumentCell{dissipation_text(m.dissipation),
                                         m.dissipation.is_tested ? m.dissipation.share : kNoNumber};
                   }});

    // Behaviour beyond the data: in a word, and on a page with the number to sort by.
    all.push_back({"bounded", {.title = "Bounded"}, [](Model m) {
                     return DocumentCell{stress_text(m.stress)};
                   }});
    all.push_back({"largest_spans",
                   {.title = "Bounded",
                    .hint = "Largest force at twice the stroke and speed of the data, in force "
                            "spans of the data; more than 10 is called unbounded"},
                   [](Model m) {
                     const StressRun& run = m.stress;
                     if (run.seconds == 0 || !run.finite) return DocumentCell{stress_text(run)};
                     return DocumentCell{std::string(run.is_bounded() ? "yes, " : "no, ") +
                                             number_text(run.largest_share, 2),
                                         run.largest_share};
                   }});
    return all;
  }();
  return kColumns;
}

const ModelColumn& column_named(const std::string& name) {
  const auto found = std::ranges::find(model_columns(), name, &ModelColumn::name);
  assert(found != model_columns().end());
  return *found;
}

std::string level_title(const DriveResult& drive, const std::string& unit) {
  const std::string low = format_number(drive.low, 3);
  return drive.low == drive.high ? level_text(drive.low, unit)
                                 : low + " ... " + format_number(drive.high, 3) + " " + unit;
}

std::string interval_text(const FittedParameter& p) {
  if (p.fixed) return "fixed";
  if (std::isnan(p.low)) return "none";
  return fmt::format("[{}, {}]", number_text(p.low, 4), number_text(p.high, 4));
}

std::string remark(const FittedParameter& p) {
  return std::string(p.at_bound ? "at its bound" : "") + (p.at_bound && p.weak ? ", " : "") +
         (p.weak ? "weakly determined" : "");
}

/// The names of forces end with their SI unit.
using MetricColumn = std::pair<const char*, double Metrics::*>;
constexpr MetricColumn kMetricColumns[] = {{"rmse_N", &Metrics::rmse},
                                           {"rms_half_span_percent", &Metrics::rms_half_span},
                                           {"rms_span_percent", &Metrics::rms_span},
                                           {"nrmse_max_percent", &Metrics::nrmse_max},
                                           {"esr_percent", &Metrics::esr},
                                           {"r2", &Metrics::r2},
                                           {"rrse", &Metrics::rrse},
                                           {"fit_percent", &Metrics::fit},
                                           {"vaf_percent", &Metrics::vaf},
                                           {"mae_N", &Metrics::mae},
                                           {"max_error_N", &Metrics::max_error}};

const std::vector<RecordResult>& results_of(const RankedModel& model, ShownRecord::Part part) {
  return part == ShownRecord::Part::LeftOut      ? model.left_out.records
         : part == ShownRecord::Part::Validation ? model.validation.records
                                                 : model.training.records;
}

/// The factor of a column, and its name with the unit in which its forces are.
std::pair<std::string, double> csv_column(std::string_view name, const PrintUnits& units) {
  if (!name.ends_with("_N")) return {std::string(name), 1};
  name.remove_suffix(1);
  const PrintUnit force = units.of("N");
  return {std::string(name) + force.name, force.factor};
}

std::string csv_line(const RankedModel& model, const RecordResult& record,
                     const std::string& left_out, const PrintUnits& units) {
  const auto optional_text = [](const std::optional<double>& value) {
    return value ? format_exact(*value) : std::string();
  };
  std::vector<std::string> fields = {csv_field(model.name),
                                     csv_field(record.record),
                                     csv_field(record.condition),
                                     optional_text(record.drive_level),
                                     left_out,
                                     std::to_string(record.metrics.samples)};
  for (const auto& [name, member] : kMetricColumns)
    fields.push_back(format_exact(csv_column(name, units).second * record.metrics.*member));
  for (const double value : {record.metrics_without_offset.esr,
                             units.of("N").factor * record.offset, record.energy_error})
    fields.push_back(format_exact(value));
  fields.push_back(optional_text(record.diverged_at));
  return join(fields, ",") + "\n";
}

}  // namespace

std::string ShownRecord::label() const {
  return name + (part == Part::LeftOut      ? ""
                 : part == Part::Validation ? " (validation)"
                                            : " (training)");
}

const RecordResult* ShownRecord::of(const RankedModel& model) const {
  const auto& results = results_of(model, part);
  const auto found = std::ranges::find(results, name, &RecordResult::record);
  return found == results.end() ? nullptr : &*found;
}

std::vector<ShownRecord> shown_records(const Ranking& ranking) {
  using enum ShownRecord::Part;
  std::vector<ShownRecord> records;
  std::set<std::pair<ShownRecord::Part, std::string>> known;
  for (const ShownRecord::Part part : {LeftOut, Validation, Training})
    for (const RankedModel& model : ranking.models)
      for (const RecordResult& result : results_of(model, part))
        if ((part == LeftOut || !result.time.empty()) &&
            !(part == Training && known.contains({LeftOut, result.record})) &&
            known.emplace(part, result.record).second)
          records.push_back({result.record, part});
  return records;
}

DocumentTable model_table(const Ranking& ranking, const std::vector<ColumnChoice>& columns) {
  DocumentTable table;
  for (const ColumnChoice& choice : columns) {
    TextColumn look = column_named(choice.name).look;
    look.priority = choice.priority;
    look.audience = choice.audience;
    look.elastic = !look.numeric && look.title != "Status" && look.title != "Apart";
    table.columns.push_back(look);
  }

  const std::vector<ShownRecord> records = shown_records(ranking);
  const std::vector<const RankedModel*> leaders = ranking.leaders();
  for (const RankedModel& model : ranking.models) {
    const std::size_t place = table.rows.size();
    std::vector<DocumentCell> row;
    for (const ColumnChoice& choice : columns)
      row.push_back(choice.name == std::string("place") ? DocumentCell{std::to_string(place + 1)}
                                                        : column_named(choice.name).cell(model));
    add_row(table, row);
    table.warnings.push_back(!is_recommendable(model));
    table.leaders.push_back(std::ranges::find(leaders, &model) != leaders.end());
    table.chooses.push_back({{"model", place}});
    const auto worst = std::ranges::find(records, model.left_out.worst_record, &ShownRecord::name);
    if (worst != records.end())
      table.chooses.back().emplace_back("record",
                                        static_cast<std::size_t>(worst - records.begin()));
  }
  return table;
}

DocumentTable breakdown_table(const Ranking& ranking, DriveUnit drive_unit) {
  DocumentTable table{
      .title = "RMS error in " + unit_name("N") + " by speed, and ESR in % by drive",
      .columns = {{.title = "Model", .elastic = true}},
      .rows = {}};
  for (const RankedModel& model : ranking.models) {
    if (!is_judged(model)) continue;

    // The first judged model says which bands and levels there are.
    const bool is_first = table.rows.empty();
    std::vector<std::string> row = {model.name};
    for (const BandResult& band : model.left_out.bands) {
      if (is_first)
        table.columns.push_back({split(band.name, ',').front() + ' ' + unit_name("N"), true});
      row.push_back(quantity(band.metrics.rmse, "N"));
    }
    for (const DriveResult& drive : model.left_out.drive) {
      if (is_first) table.columns.push_back({level_title(drive, to_string(drive_unit)), true, 1});
      row.push_back(percent_text(drive.metrics.esr));
    }
    row.resize(table.columns.size(), "-");  // a model that diverged has fewer levels
    table.rows.push_back(std::move(row));
  }
  return table;
}

DocumentTable interval_table(const Ranking& ranking) {
  DocumentTable table{
      .title = fmt::format(
          "{:.0f} % intervals of the force, each made without the records that it is judged on",
          100 * kCoverage),
      .columns = {{.title = "Model", .elastic = true},
                  {"Covered %", true},
                  {"Worst %", true},
                  {.title = "Worst record", .priority = 2, .elastic = true},
                  {"Width " + unit_name("N"), true},
                  {"of span %", true, 1}},
      .rows = {}};

  // Models without an interval have no row.
  for (const RankedModel& model : ranking.models) {
    const Coverage& all = model.left_out.coverage;
    if (const RecordResult* worst = model.left_out.worst_covered())
      table.rows.push_back(
          {model.name, percent_text(all.percent()), percent_text(worst->coverage.percent()),
           worst->record, quantity(all.mean_width(), "N"), percent_text(all.mean_width_percent())});
  }
  return table;
}

DocumentTable parameter_table(const FitReport& fit) {
  DocumentTable table{.title = {},
                      .columns = {{"Parameter"},
                                  {"Value", true},
                                  {"95 % interval"},
                                  {"Unit"},
                                  {.title = "Meaning", .priority = 1, .elastic = true},
                                  {"Remark"}},
                      .rows = {}};

  // Intervals sort by their width.
  for (const FittedParameter& p : fit.parameters) {
    add_row(table, {{p.name},
                    {number_text(p.value, 5), p.value},
                    {interval_text(p), p.fixed ? kNoNumber : p.high - p.low},
                    {p.unit},
                    {p.meaning},
                    {remark(p)}});
    table.warnings.push_back(p.at_bound || p.weak);
  }
  return table;
}

DocumentTable record_table(const Evaluation& evaluation, const std::string& title) {
  DocumentTable table{
      .title = {},
      .columns = {{.title = title, .elastic = true},
                  {"ESR %", true},
                  {"RMSE " + unit_name("N"), true},
                  {.title = "Fit %", .numeric = true, .descending = true},
                  {.title = "Offset " + unit_name("N"),
                   .numeric = true,
                   .hint = "Added to the model's force: the zero of the load cell, gas"},
                  {"No offs. %", true, 1},
                  {"Energy %", true, 1},
                  {.title = "Covered %", .numeric = true, .descending = true},
                  {.title = "Diverged at", .numeric = true}},
      .rows = {}};

  // One row per record; a diverged one says when.
  const auto percent = [](double value) { return DocumentCell{percent_text(value), value}; };
  for (const RecordResult& r : evaluation.records) {
    const std::string end = r.diverged_at ? number_text(*r.diverged_at) + " s" : "";
    add_row(table, {{r.record},
                    percent(r.metrics.esr),
                    {quantity(r.metrics.rmse, "N"), r.metrics.rmse},
                    percent(r.metrics.fit),
                    {quantity(r.offset, "N"), r.offset},
                    percent(r.metrics_without_offset.esr),
                    percent(r.energy_error),
                    percent(r.coverage.percent()),
                    {end, r.diverged_at.value_or(kNoNumber)}});
    table.warnings.push_back(r.diverged_at.has_value());
  }
  return table;
}

std::string interval_sentence(const Evaluation& evaluation) {
  const RecordResult* worst = evaluation.worst_covered();
  if (!worst) return "";
  const Coverage& all = evaluation.coverage;
  return fmt::format(
      "The {:.0f} % interval of the model covers {} % of the samples, {} % of the worst record "
      "({}); its mean width is {} {}, {} % of the force span.",
      100 * worst->band->level, percent_text(all.percent()),
      percent_text(worst->coverage.percent()), worst->record, quantity(all.mean_width(), "N"),
      unit_name("N"), percent_text(all.mean_width_percent()));
}

std::string over_first_text(const RankedModel& model) {
  if (!model.over_first) return "-";
  const PairedRatio& ratio = *model.over_first;
  return format_number(ratio.low, 3) + " ... " + format_number(ratio.high, 3);
}

std::string forgetting_text(const Forgetting& result) {
  if (!result.is_tested) return "-";
  if (result.is_forgotten()) return number_text(result.seconds, 2) + " s";
  return std::isfinite(result.share_left) ? "no, " + percent_text(100 * result.share_left) + " %"
                                          : "diverges";
}

std::string dissipation_text(const Dissipation& result) {
  if (!result.is_tested) return "-";
  if (result.dissipates()) return "yes";
  std::string band = number_text(result.active_from, 3);
  if (result.active_to > result.active_from) band += " to " + number_text(result.active_to, 3);
  return "no, " + band + " Hz";
}

std::string stress_text(const StressRun& run) {
  if (run.seconds == 0) return "-";
  if (!run.finite) return "diverged";
  return run.is_bounded() ? "yes" : fmt::format("{} spans", number_text(run.largest_share, 2));
}

std::string csv_report(const ReportInput& input) {
  std::string text =
      "model,record,condition,drive_" + name_of(input.dataset.drive_unit) + ",left_out,samples";
  const PrintUnits& units = input.file_units;
  for (const auto& [name, member] : kMetricColumns) text += ',' + csv_column(name, units).first;
  text += ",esr_without_offset_percent," + csv_column("offset_N", units).first +
          ",energy_error_percent,diverged_at_s\n";
  for (const RankedModel& model : input.ranking.models) {
    for (const RecordResult& record : model.left_out.records)
      text += csv_line(model, record, "yes", units);
    for (const RecordResult& record : model.validation.records)
      text += csv_line(model, record, "validation", units);
    for (const RecordResult& record : model.training.records)
      text += csv_line(model, record, "no", units);
  }
  return text;
}

std::string csv_leaderboard(const ReportInput& input) {
  constexpr std::array kFigures{"esr_percent",       "training_esr_percent", "mean_esr_percent",
                                "worst_esr_percent", "pre_yield_rmse_N",     "energy_error_percent",
                                "parameters",        "nanoseconds_per_step", "fit_cpu_seconds"};
  std::vector<std::string> titles;
  for (const char* name : kFigures) titles.push_back(csv_column(name, input.file_units).first);
  std::string text =
      "rank,model,usable," + join(titles, ",") +
      ",stress_finite,stress_largest_spans,diverged_records,over_first_times,over_first_low,"
      "over_first_high,told_apart,forgets,forgets_after_s,dissipates,least_share,"
      "wall_seconds_of_all" +
      predicted_csv_titles(input.ranking) + "\n";

  // Figures of models that were not judged stay empty.
  std::size_t rank = 0;
  for (const RankedModel& model : input.ranking.models) {
    std::vector<std::string> fields = {std::to_string(++rank), csv_field(model.name),
                                       is_usable(model) ? "yes" : "no"};
    for (const char* name : kFigures)
      fields.push_back(is_judged(model) ? format_exact(csv_column(name, input.file_units).second *
                                                       column_named(name).cell(model).key)
                                        : "");
    fields.insert(fields.end(),
                  {model.stress.finite ? "yes" : "no", format_exact(model.stress.largest_share),
                   std::to_string(model.left_out.diverged)});
    for (double PairedRatio::* figure :
         {&PairedRatio::times, &PairedRatio::low, &PairedRatio::high})
      fields.push_back(model.over_first ? format_exact((*model.over_first).*figure) : "");
    const Forgetting& forgetting = model.forgetting;
    fields.insert(fields.end(),
                  {!model.over_first              ? ""
                   : model.over_first->is_worse() ? "yes"
                                                  : "no",
                   forgetting.is_forgotten() ? "yes" : "no",
                   forgetting.is_tested ? format_exact(forgetting.seconds) : "",
                   model.dissipation.dissipates() ? "yes" : "no",
                   model.dissipation.is_tested ? format_exact(model.dissipation.share) : "",
                   format_exact(input.ranking.wall_seconds)});
    text += join(fields, ",") + predicted_csv(input.ranking, model) + "\n";
  }
  return text;
}

}  // namespace dashpot
