#include "dashpot/report/leaderboard.h"

#include <functional>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/identify/judge/stress.h"
#include "dashpot/report/interval_table.h"
#include "dashpot/report/safe_text.h"
#include "dashpot/report/text_table.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

/// A figure of the leaderboard: its title for people, its name for programs, and its value.
struct Figure {
  std::string title, name;
  int priority;  ///< as in TextColumn
  std::function<double(const RankedModel&)> value;
  std::string (*text)(double);
};

std::string three_digits(double value) { return number_text(value, 3); }
std::string two_digits(double value) { return number_text(value, 2); }
std::string whole(double value) { return fmt::format("{:.0f}", value); }

double parameters_of(const RankedModel& m) {
  return m.fit.model ? static_cast<double>(m.fit.model->parameter_count()) : 0;
}

double pre_yield_rmse(const RankedModel& m) {
  return m.left_out.bands.empty() ? 0 : m.left_out.bands.front().metrics.rmse;
}

const std::vector<Figure>& figures() {
  static const std::vector<Figure> kFigures = {
      {"ESR %", "esr_percent", 0, [](const auto& m) { return m.left_out.pooled.esr; },
       percent_text},
      {"Train %", "training_esr_percent", 0, [](const auto& m) { return m.training.pooled.esr; },
       percent_text},
      {"Mean %", "mean_esr_percent", 1, [](const auto& m) { return m.left_out.mean_esr; },
       percent_text},
      {"Worst %", "worst_esr_percent", 1, [](const auto& m) { return m.left_out.worst_esr; },
       percent_text},
      {"Slow N", "pre_yield_rmse_N", 1, pre_yield_rmse, three_digits},
      {"Energy %", "energy_error_percent", 2,
       [](const auto& m) { return m.left_out.mean_energy_error; }, percent_text},
      {"Par.", "parameters", 1, parameters_of, whole},
      {"ns/step", "nanoseconds_per_step", 1, [](const auto& m) { return m.nanoseconds_per_step; },
       three_digits},
      {"Fit s", "fit_cpu_seconds", 1, [](const auto& m) { return m.seconds; }, two_digits}};
  return kFigures;
}

std::string status_text(const RankedModel& model) {
  if (!model.fit.model || model.fit.status == FitReport::Status::Failed) return "fit failed";
  if (model.left_out.diverged) return fmt::format("{} diverged", model.left_out.diverged);
  return model.fit.status == FitReport::Status::IterationLimit ? "limit" : "";
}

std::vector<TextColumn> leaderboard_columns() {
  std::vector<TextColumn> columns = {{"#", true}, {"Model", false, 0, true}};
  for (const Figure& figure : figures()) columns.push_back({figure.title, true, figure.priority});
  columns.push_back({"Bounded", false, 1});
  columns.push_back({"Status"});
  return columns;
}

std::vector<std::vector<std::string>> leaderboard_rows(const Ranking& ranking) {
  std::vector<std::vector<std::string>> rows;
  for (const RankedModel& model : ranking.models) {
    const bool judged = is_judged(model);
    std::vector<std::string> row = {std::to_string(rows.size() + 1), model.name};
    for (const Figure& figure : figures())
      row.push_back(judged ? figure.text(figure.value(model)) : "-");
    row.push_back(stress_text(model.stress));
    row.push_back(status_text(model));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string level_title(const DriveResult& drive, const std::string& unit) {
  const std::string low = format_number(drive.low, 3);
  return drive.low == drive.high ? low + " " + unit
                                 : low + " ... " + format_number(drive.high, 3) + " " + unit;
}

/// Columns and rows; those of the first judged model say which bands and levels there are.
struct Breakdown {
  std::vector<TextColumn> columns = {{"Model", false, 0, true}};
  std::vector<std::vector<std::string>> rows;
};

Breakdown breakdown(const Ranking& ranking, const std::string& unit) {
  Breakdown result;
  for (const RankedModel& model : ranking.models) {
    if (!is_judged(model)) continue;
    const bool first = result.rows.empty();
    std::vector<std::string> row = {model.name};
    for (const BandResult& band : model.left_out.bands) {
      if (first) result.columns.push_back({split(band.name, ',').front() + " N", true});
      row.push_back(number_text(band.metrics.rmse, 3));
    }
    for (const DriveResult& drive : model.left_out.drive) {
      if (first) result.columns.push_back({level_title(drive, unit), true, 1});
      row.push_back(percent_text(drive.metrics.esr));
    }
    row.resize(result.columns.size(), "-");  // a model that diverged has fewer levels
    result.rows.push_back(std::move(row));
  }
  return result;
}

}  // namespace

std::string stress_text(const StressRun& run) {
  if (run.seconds == 0) return "-";
  if (!run.finite) return "diverged";
  return run.is_bounded() ? "yes" : fmt::format("{} spans", number_text(run.largest_share, 2));
}

std::string leaderboard_table(const Ranking& ranking, int width) {
  return text_table(leaderboard_columns(), leaderboard_rows(ranking), width);
}

std::string breakdown_table(const Ranking& ranking, DriveUnit drive_unit, int width) {
  const Breakdown table = breakdown(ranking, to_string(drive_unit));
  return text_table(table.columns, table.rows, width);
}

std::string markdown_leaderboard(const ReportInput& input, const std::string& heading) {
  const Ranking& ranking = input.ranking;
  const Breakdown parts = breakdown(ranking, to_string(input.dataset.drive_unit));
  std::string text = heading + " " + markdown_cell(input.dataset.name) + "\n\n" +
                     markdown_cell(verdict(ranking)) +
                     "\n\nLeft out: " + format_leave_out(ranking.leave_out) + ". " +
                     protocol(ranking.leave_out, ranking.folds.size()) + "\n\n" +
                     markdown_table(leaderboard_columns(), leaderboard_rows(ranking)) +
                     "\nRMS error in N by speed, and ESR in % by drive:\n\n" +
                     markdown_table(parts.columns, parts.rows) + markdown_intervals(ranking);
  if (!input.dataset.citation.empty())
    text += "\nData: " + markdown_cell(input.dataset.citation) + "\n";
  return text;
}

std::string csv_leaderboard(const ReportInput& input) {
  std::string text = "rank,model,usable";
  for (const Figure& figure : figures()) text += "," + figure.name;
  text += ",stress_finite,stress_largest_spans,diverged_records,wall_seconds_of_all\n";
  std::size_t rank = 0;
  for (const RankedModel& model : input.ranking.models) {
    std::vector<std::string> fields = {std::to_string(++rank), csv_field(model.name),
                                       is_usable(model) ? "yes" : "no"};
    for (const Figure& figure : figures())
      fields.push_back(is_judged(model) ? format_exact(figure.value(model)) : "");
    fields.insert(
        fields.end(),
        {model.stress.finite ? "yes" : "no", format_exact(model.stress.largest_share),
         std::to_string(model.left_out.diverged), format_exact(input.ranking.wall_seconds)});
    text += join(fields, ",") + "\n";
  }
  return text;
}

}  // namespace dashpot
