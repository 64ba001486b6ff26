#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dashpot/rank.h"
#include "dashpot/report/document.h"

// The report of a ranking: models that were fitted, and judged on records that they had not seen.
namespace dashpot {

/// Input of a report.
struct ReportInput {
  const Dataset& dataset;
  const Ranking& ranking;
  std::string command;  ///< the command line that prints all its figures again
  std::string version;
  std::string date;  ///< ISO 8601
  /// A model as a program that a page runs (export/js/js.h); null: the page has no sliders.
  std::function<JsText(const ModelFile&)> program = {};
  PrintUnits units = {};                     ///< of the page, the words and the figures
  PrintUnits file_units = PrintUnits::si();  ///< of the lines for programs
};

/// The ranking, one model on one record in full, all records, what was fitted and how it was
/// judged. Its data are json_report().
Document ranking_document(const ReportInput& input);
/// The full comparison: accuracy on left-out records in several ways, beside what each model costs
/// and whether it stays bounded beyond its data. Tables alone, without a command and a date, as a
/// part of a page.
Document leaderboard_document(const ReportInput& input);
/// The ranking of a single model that was fitted elsewhere; as text its errors by record and speed.
Document evaluation_document(const ReportInput& input);

/// Every figure of a ranking, for programs.
Value json_report(const ReportInput& input);
/// One line per model and record: model, record, condition, drive, left out, every metric.
std::string csv_report(const ReportInput& input);
/// One line per model with every figure of the leaderboard.
std::string csv_leaderboard(const ReportInput& input);

/// Figures for print, as SVG and PDF, drawn by gnuplot into `folder`; each script with its data
/// stays beside its figures. Throws Error when gnuplot is missing or fails. Returns the paths of
/// the figures.
std::vector<std::filesystem::path> write_figures(const ReportInput& input,
                                                 const std::filesystem::path& folder);

}  // namespace dashpot
