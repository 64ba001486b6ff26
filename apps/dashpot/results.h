#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/base/date.h"
#include "dashpot/identify.h"
#include "dashpot/identify/rank/fit_store.h"
#include "dashpot/rank.h"
#include "dashpot/report/report.h"

namespace dashpot::cli {

/// The folder of the results of an identification, and which of them are written.
struct ResultSettings {
  std::string folder = "dashpot-results";
  bool report = true;
  bool pdf = false;
  bool figures = false;
  std::string units = {};  ///< of --units
};

std::vector<Option> result_options(ResultSettings& settings);

/// The report, and on stderr what to beware of.
void print_results(const Document& report, const Ranking& ranking, Console& console);

/// Makes the folder, so that hours of fitting do not end at one that cannot be written.
void prepare_results(const ResultSettings& settings);

/// The place where the names of the written files are printed: among the results, or on stderr
/// beside a page that is the result.
enum class Say { Result, Aside };

/// What a researcher takes along of an identification, where it is asked for.
struct KitSettings {
  std::string traces, covariance;  ///< formats; empty: not written
};
std::vector<Option> kit_options(KitSettings& settings);
/// Writes the traces of every record that is shown, model by model, and the laws' numbers with
/// their covariance, into folders of their own, and prints where they are.
void write_kit(const ReportInput& input, const KitSettings& kit, const ResultSettings& settings,
               Console& console);

/// Writes model files, report and figures, and prints where they are.
void write_results(const ReportInput& input, const Document& report, const ResultSettings& settings,
                   Console& console, Say say = Say::Result);

/// kDone, or kNotUsable with the reason printed when no model gave a finite force.
int exit_code_of(const Ranking& ranking, Console& console);

/// This very build: a fit that another one made may differ.
std::string program_id();

/// The file in the folder that keeps finished work: "fits.sqlite" for `what` = "fits". Prints a
/// note where an older version left such work in a folder "fits", which stays as it is and is not
/// read.
std::filesystem::path kept_file(const std::filesystem::path& folder, const std::string& what,
                                Console& console);
/// The fits that are kept there; says where some of them are damaged.
std::unique_ptr<FitStore> kept_fits(const std::filesystem::path& folder, Console& console);

/// Says, where there are any, that kept results were damaged and are made again.
void tell_dropped(std::size_t count, const std::filesystem::path& file, Console& console);
/// Says, where there are any, that finished fits were found and not made again.
void tell_kept(std::size_t count, Console& console);

/// Input of a report, with the command line, today as its date, and the stated units.
ReportInput report_input(const Dataset& dataset, const Ranking& ranking, const std::string& units,
                         const Console& console);

}  // namespace dashpot::cli
