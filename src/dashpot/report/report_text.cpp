// The report for a terminal, as Markdown and as CSV.
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/interval_table.h"
#include "dashpot/report/report.h"
#include "dashpot/report/safe_text.h"
#include "dashpot/report/text_table.h"
#include "dashpot/report/words.h"

namespace dashpot {

namespace {

std::string seconds_text(double seconds) {
  return seconds < 1 ? fmt::format("{:.0f} ms", 1000 * seconds) : number_text(seconds, 2) + " s";
}

std::string status_text(const RankedModel& model) {
  if (model.left_out.diverged) return fmt::format("{} diverged", model.left_out.diverged);
  if (model.fit.status == FitReport::Status::Failed) return "fit failed";
  return model.fit.status == FitReport::Status::IterationLimit ? "limit" : "";
}

const std::vector<TextColumn> kRankingColumns = {
    {"Model", false, 0, true}, {"ESR %", true},
    {"RMSE N", true},          {"Fit %", true},
    {"R2", true, 6},           {"rms/half %", true, 4},
    {"Worst %", true},         {"Worst record", false, 5, true},
    {"No offs. %", true, 1},   {"Train %", true, 2},
    {"Par.", true, 3},         {"ns/step", true, 7},
    {"Time", true, 3},         {"Status"}};

std::vector<std::string> ranking_row(const RankedModel& model) {
  const Metrics& pooled = model.left_out.pooled;
  return {model.name,
          percent_text(pooled.esr),
          number_text(pooled.rmse),
          percent_text(pooled.fit),
          number_text(pooled.r2, 4),
          percent_text(pooled.rms_half_span),
          percent_text(model.left_out.worst_esr),
          model.left_out.worst_record,
          percent_text(model.left_out.pooled_without_offset.esr),
          percent_text(model.training.pooled.esr),
          model.fit.model ? std::to_string(model.fit.model->parameter_count()) : "-",
          number_text(model.nanoseconds_per_step, 3),
          seconds_text(model.seconds),
          status_text(model)};
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

std::string markdown_ranking(const Ranking& ranking) {
  std::vector<std::vector<std::string>> rows;
  for (const RankedModel& model : ranking.models) rows.push_back(ranking_row(model));
  return markdown_table(kRankingColumns, rows);
}

std::string markdown_model(const RankedModel& model) {
  std::string text = "\n### " + markdown_cell(display_name(model)) + "\n\n";
  if (!model.fit.parameters.empty()) {
    text += "| Parameter | Value | 95 % interval | Unit | Meaning |\n|---|---:|---:|---|---|\n";
    for (const FittedParameter& p : model.fit.parameters) {
      const std::string remarks = remark(p);
      text += markdown_row({p.name, number_text(p.value, 5), interval_text(p), p.unit,
                            p.meaning + (remarks.empty() ? "" : fmt::format(" ({})", remarks))});
    }
    text += "\n";
  }
  for (const std::string& warning : model.fit.warnings)
    text += fmt::format("* {}\n", markdown_cell(warning));
  text +=
      "\n| Left-out record | ESR % | RMSE N | Fit % | Offset N | Covered % "
      "|\n|---|---:|---:|---:|---:|---:|\n";
  for (const RecordResult& r : model.left_out.records)
    text +=
        markdown_row({r.record + (r.diverged_at ? " (diverged)" : ""), percent_text(r.metrics.esr),
                      number_text(r.metrics.rmse), percent_text(r.metrics.fit),
                      number_text(r.offset), percent_text(r.coverage.percent())});
  return text;
}

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

std::string csv_line(const RankedModel& model, const RecordResult& record, bool left_out) {
  const auto optional_text = [](const std::optional<double>& value) {
    return value ? format_exact(*value) : std::string();
  };
  std::vector<std::string> fields = {
      csv_field(model.name),       csv_field(record.record),
      csv_field(record.condition), optional_text(record.drive_level),
      left_out ? "yes" : "no",     std::to_string(record.metrics.samples)};
  for (const auto& [name, member] : kMetricColumns)
    fields.push_back(format_exact(record.metrics.*member));
  for (const double value : {record.metrics_without_offset.esr, record.offset, record.energy_error})
    fields.push_back(format_exact(value));
  fields.push_back(optional_text(record.diverged_at));
  return join(fields, ",") + "\n";
}

}  // namespace

std::string ranking_table(const Ranking& ranking, int width) {
  std::vector<std::vector<std::string>> rows;
  for (const RankedModel& model : ranking.models) rows.push_back(ranking_row(model));
  return text_table(kRankingColumns, rows, width);
}

std::string parameter_table(const FitReport& fit) {
  std::vector<std::vector<std::string>> rows;
  for (const FittedParameter& p : fit.parameters)
    rows.push_back({p.name, number_text(p.value, 5), interval_text(p), p.unit, remark(p)});
  return text_table({{"Parameter"}, {"Value", true}, {"95 % interval"}, {"Unit"}, {""}}, rows, 100);
}

std::string markdown_report(const ReportInput& input) {
  const Ranking& ranking = input.ranking;
  std::string text =
      "# " + markdown_cell(input.dataset.name) + "\n\n" + markdown_cell(verdict(ranking)) + "\n\n" +
      "Percent are ESR, free run, left-out records, one offset per record, unless said "
      "otherwise. " +
      protocol(ranking.leave_out, ranking.folds.size()) + "\n\n" + markdown_ranking(ranking);
  if (const auto note = one_step_note(ranking)) text += "\n" + *note + "\n";
  text += markdown_intervals(ranking) + "\n## Models\n";
  for (const RankedModel& model : ranking.models) text += markdown_model(model);
  text += "\n## Provenance\n\n    " + valid_utf8(input.command) + "\n\n" +
          fmt::format("Dashpot {}, {}.", input.version, input.date);
  if (!input.dataset.citation.empty()) text += " Data: " + markdown_cell(input.dataset.citation);
  text += "\n\n";
  for (const SourceFile& file : input.dataset.files)
    text += "* " + markdown_cell(file.path) + ", SHA-256 " + file.sha256 + "\n";
  return text;
}

std::string csv_report(const ReportInput& input) {
  std::string text =
      "model,record,condition,drive_" + to_string(input.dataset.drive_unit) + ",left_out,samples";
  for (const auto& [name, member] : kMetricColumns) text += std::string(",") + name;
  text += ",esr_without_offset_percent,offset_N,energy_error_percent,diverged_at_s\n";
  for (const RankedModel& model : input.ranking.models) {
    for (const RecordResult& record : model.left_out.records) text += csv_line(model, record, true);
    for (const RecordResult& record : model.training.records)
      text += csv_line(model, record, false);
  }
  return text;
}

}  // namespace dashpot
