#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "dashpot/identify.h"
#include "dashpot/rank.h"
#include "dashpot/value.h"

namespace dashpot {

/// What a report is made from.
struct ReportInput {
  const Dataset& dataset;
  const Ranking& ranking;
  std::string command;  ///< the command line that prints all its figures again
  std::string version;
  std::string date;  ///< ISO 8601
};

/// One self-contained page (styles, script and data inside; it asks the network for nothing).
std::string html_report(const ReportInput& input);
/// The same numbers for programs and for text.
Value json_report(const ReportInput& input);
std::string markdown_report(const ReportInput& input);
/// One line per model and record: model, record, condition, drive, left out, every metric.
std::string csv_report(const ReportInput& input);

/// The ranking as a table for a terminal, best first. `width`: columns available.
std::string ranking_table(const Ranking& ranking, int width = 100);
std::string parameter_table(const FitReport& fit);

/// Figures for print, as SVG and PDF, drawn by gnuplot into `folder`; each script with its data
/// stays beside its figures. Throws Error when gnuplot is missing or fails. Returns the paths of
/// the figures.
std::vector<std::filesystem::path> write_figures(const ReportInput& input,
                                                 const std::filesystem::path& folder);

}  // namespace dashpot
