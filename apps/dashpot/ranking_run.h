#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/identify/rank/fit_store.h"
#include "data.h"
#include "identify_options.h"
#include "results.h"

namespace dashpot::cli {

/// The settings that `identify` and `rank` share.
struct RankingSettings {
  DataSettings data;
  FitSettings fit;
  ResultSettings results;
  std::string leave_out;
  bool fresh = false;
};

Option leave_out_option(std::string& text);
/// The choice on the command line, checked before the long work starts; nothing without one.
/// Throws UsageError.
std::optional<LeaveOut> stated_leave_out(const std::string& text);

std::vector<Option> ranking_options(RankingSettings& settings);
/// Of commands that use fit_store().
Option fresh_option(RankingSettings& settings);
/// Of commands that take first_starts() into their fits.
Option from_option(RankingSettings& settings);

struct RankingData {
  Dataset dataset;
  LeaveOut leave_out;
};

/// Reads the recordings, makes the folder of the results and settles what is left out.
RankingData ranking_data(const RankingSettings& settings, Console& console);

/// Where finished fits are kept, beside the results, so that an interrupted run goes on; nothing
/// with --fresh.
std::unique_ptr<FitStore> fit_store(const RankingSettings& settings, Console& console);

}  // namespace dashpot::cli
