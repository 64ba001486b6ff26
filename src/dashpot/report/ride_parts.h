#pragma once
#include <string>
#include <vector>

#include "dashpot/report/document.h"
#include "dashpot/suspension/ride/simulated_run.h"

// Parts that the pages of a suspension share.
namespace dashpot {

/// How the curves of the k-th controller look; the passive reference is grey.
FigureSeries controller_look(const std::string& name, std::size_t k);
FigureSeries passive_look(const std::string& name);

/// A stretch of time, s.
struct Stretch {
  double from = 0, to = 0;
};
/// The stretch of a run that a figure shows: five seconds of a ground that is alike all along, all
/// of another one.
Stretch shown_stretch(double duration, double discard);

/// A channel over time, thinned to what a screen can show; `factor` as the axis has it.
FigureSeries over_time(const SimulatedRun& run, const std::string& channel, double factor,
                       const Stretch& stretch, const FigureSeries& look);
/// The same of samples at these times, s.
FigureSeries over_time(const std::vector<double>& time, const std::vector<double>& samples,
                       double factor, const Stretch& stretch, const FigureSeries& look);

/// "0.97"; "-" where there is no ratio.
std::string ratio_text(double value, double reference);

/// "22 % less", "0.5 % more": of a value against a reference.
std::string against_text(double value, double reference);

/// Remarks on runs: warnings with the run's name, then the vehicle's notes, each once.
std::vector<std::string> run_remarks(const std::vector<const SimulatedRun*>& runs);

}  // namespace dashpot
