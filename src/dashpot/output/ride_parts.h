#pragma once
#include <string>
#include <vector>

#include "dashpot/output/document.h"
#include "dashpot/suspension/simulated_run.h"

// Parts that the pages of a suspension share.
namespace dashpot {

/// Of the k-th controller; the passive reference is "series-6".
std::string controller_colour(std::size_t k);
constexpr std::string_view kPassiveColour = "series-6";

/// A channel over time, thinned to what a screen can show; `factor` as the axis has it.
FigureSeries over_time(const SimulatedRun& run, const std::string& channel, double factor,
                       const FigureSeries& look);

/// "0.97"; "-" where there is no ratio.
std::string ratio_text(double value, double reference);

/// What is to be said of runs: warnings with the run's name, then the vehicle's notes, each once.
std::vector<std::string> run_remarks(const std::vector<const SimulatedRun*>& runs);

}  // namespace dashpot
