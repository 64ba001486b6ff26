#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/base/date.h"
#include "dashpot/identify.h"
#include "dashpot/rank.h"
#include "dashpot/report/report.h"

namespace dashpot::cli {

/// Where the results of an identification go, and which.
struct ResultSettings {
  std::string folder = "dashpot-results";
  bool report = true;
  bool figures = false;
};

std::vector<Option> result_options(ResultSettings& settings);

/// The ranking, the best model's parameters and what to beware of.
void print_results(const ReportInput& input, Console& console);

/// The intervals of all models with a title, or nothing.
std::string interval_part(const Ranking& ranking, const Console& console);

/// Makes the folder, so that hours of fitting do not end at one that cannot be written.
void prepare_results(const ResultSettings& settings);

/// Where it stands that files were written: among the results, or beside a page that is the result.
enum class Say { Result, Aside };

/// Writes model files, report and figures, and prints where they are.
void write_results(const ReportInput& input, const ResultSettings& settings, Console& console,
                   Say say = Say::Result);

/// kDone, or kNotUsable with the reason printed when no model gave a finite force.
int exit_code_of(const Ranking& ranking, Console& console);

/// This very build: a fit that another one made may differ.
std::string program_id();

/// What stands in a report beside the figures.
ReportInput report_input(const Dataset& dataset, const Ranking& ranking, const Console& console);

}  // namespace dashpot::cli
