#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "campaign.h"

namespace dashpot::cli {

/// A virtual family: what is drawn, and how builds of one drawing differ.
struct FamilyBenchSettings {
  std::vector<std::string> drawings;  ///< files or folders of them; none: one damper is benched
  std::vector<std::string> fluids;    ///< in place of the drawings' own: each with each
  std::uint64_t builds = 1;           ///< of each drawing
  double scatter = 0.03;              ///< standard deviation of a build's strength, as a share
  double asymmetry = 0;
  std::string give = "0.3 mm";  ///< of the spring in series, at the largest current
};

std::vector<Option> family_bench_options(FamilyBenchSettings& settings);

/// Records every build of every drawing with every fluid, and writes the recordings, the drawings
/// as they were built from, manifest.csv (which recording is of which drawing and build) and
/// dataset.yaml, whose comments state the truth. Returns what was written, in words.
struct FamilyBench {
  std::size_t drawings = 0, dampers = 0, records = 0;
  std::filesystem::path statement;
  std::vector<std::string> warnings;  ///< drawings that were moved beyond their stroke
};
FamilyBench bench_family(const FamilyBenchSettings& family, const CampaignSettings& campaign,
                         const std::filesystem::path& folder, const std::string& command);

}  // namespace dashpot::cli
