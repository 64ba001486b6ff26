#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/virtual_bench.h"

namespace dashpot::cli {

/// The damper, motions, drives and sensors of a virtual test campaign.
struct CampaignSettings {
  CampaignSettings();

  std::string damper = "spencer1997";
  std::vector<std::string> motions;  ///< "25x0.25": mm x Hz
  std::vector<std::string> levels;   ///< A or V; none: the damper's, or five over its range
  std::string motion, drive;         ///< sequences in place of motions and levels
  std::string experiment;            ///< in place of all of them
  double sample_rate = 0;            ///< Hz; 0: that of bench, or of the experiment
  BenchOptions bench;
  std::string units;  ///< of --units
};

std::vector<Option> campaign_options(CampaignSettings& settings);

/// The recordings of the campaign. Throws UsageError on a motion or level that cannot be read,
/// Error on a sequence.
Dataset run_campaign(const CampaignSettings& settings, const ParameterSet& damper);

/// One CSV file per record, as a real bench would leave them, and dataset.yaml, whose comments
/// state the truth that a real bench does not know. Returns the path of dataset.yaml.
std::filesystem::path write_campaign(const Dataset& campaign, const ParameterSet& damper,
                                     const std::filesystem::path& folder,
                                     const std::string& command, const std::string& units);

/// The motions asked for, which lack their drive: sines, or one sequence.
std::vector<BenchTest> campaign_motions(const CampaignSettings& settings, BenchOptions options);
/// One of --motions, "25x0.5", and one of --levels.
SineMotion parse_motion(const std::string& text);
double parse_level(const std::string& text);
/// The levels asked for; none: none.
std::vector<double> stated_levels(const CampaignSettings& settings);
/// What to say where they go beyond what the damper is known for; else empty.
std::string levels_note(const CampaignSettings& settings, double drive_max, DriveUnit unit);
/// The name and the text of a record's CSV file, as a real bench would leave it; without stated
/// units N, mm and m/s.
std::string recording_file(const Record& record);
std::string recording_csv(const Record& record, DriveUnit drive_unit, const std::string& units);

}  // namespace dashpot::cli
