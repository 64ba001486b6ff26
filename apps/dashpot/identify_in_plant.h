#pragma once
#include <string>

#include "ranking_run.h"

namespace dashpot::cli {

/// Identifies the laws asked for as the damper of a plant, which `words` describe, from recordings
/// of that plant: prints and writes a report, and a model file per law. Throws UsageError at
/// settings that have no meaning there, Error at a plant and recordings that do not fit.
int run_in_plant(const std::string& words, const RankingSettings& settings, Console& console);

}  // namespace dashpot::cli
