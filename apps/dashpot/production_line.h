#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "campaign.h"
#include "command.h"

namespace dashpot::cli {

/// A virtual production line: dampers that scatter about one, drift, and now and then have a fault.
struct LineSettings {
  std::uint64_t dampers = 0;  ///< 0: a single damper, no line
  double scatter = 0.02;      ///< standard deviation of each parameter from damper to damper, share
  double faults = 0.02;       ///< share of the dampers that have one
  double trend = 0.03;        ///< share by which forces grow from the first damper to the last
};

std::vector<Option> line_options(LineSettings& settings);

/// Records the campaign of every damper into a folder of its own, unit-00001 ..., and writes
/// faults.csv, which names those that have a fault. The same settings give the same files, whatever
/// the number of threads. The exit code.
int record_line(const LineSettings& line, const CampaignSettings& campaign,
                const std::filesystem::path& folder, Console& console);

}  // namespace dashpot::cli
