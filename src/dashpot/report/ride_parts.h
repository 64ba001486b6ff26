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

/// Samples at these times, s, thinned to what a screen can show.
FigureSeries over_time(const std::vector<double>& time, const std::vector<double>& samples,
                       const Stretch& stretch, const FigureSeries& look);

/// A run as figures draw it.
struct DrawnRun {
  const SimulatedRun* run;
  FigureSeries look;
};
/// One channel of these runs over time; those that lack it are left out. `si_unit`: of the channel.
FigurePanel channel_panel(const std::vector<DrawnRun>& runs, const std::string& channel,
                          const std::string& title, const std::string& si_unit,
                          const Stretch& stretch);
/// For each tyre its load; for each strut its deflection, and for each its force.
std::vector<FigurePanel> tyre_and_strut_panels(const std::vector<DrawnRun>& runs,
                                               const Plant& plant, const Stretch& stretch);

/// "0.97"; "-" where there is no ratio.
std::string ratio_text(double value, double reference);

/// "22 % less", "0.5 % more": of a value against a reference.
std::string against_text(double value, double reference);

/// Remarks on runs: warnings with the run's name, then the vehicle's notes, each once.
std::vector<std::string> run_remarks(const std::vector<const SimulatedRun*>& runs);

}  // namespace dashpot
