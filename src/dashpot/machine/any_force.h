#pragma once
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/machine/lines_of_fit.h"

namespace dashpot {

// The plant's numbers whatever the forces of its dampers are.
//
// A law of another structure than the damper's leaves a force that follows the motion, and so bends
// the numbers of the plant. Where there are more sensors than dampers, some of what they show at
// each frequency depends on no damper's force: of a quarter car what both bodies' inertia adds up
// to, which is the tyre's force. So the sensors are weighed as if errors of the forces were ten
// times what the forces are (input_noise.h), which leaves that alone. The plant is linear but for
// its dampers, so that it shows a force in the same directions whatever stands for the damper.
// These numbers lean by no law; those beside the law are the more certain ones where the law is the
// damper's, and both agree within chance there (J. A. Hausman, Econometrica 46 (1978) 1251-1271).

struct BesideAnyForce {
  std::vector<double> way;  ///< per unknown of the plant: from the fit to what the sensors tell
  Jackknife told;           ///< how certain they are there, beside the unknowns that are no law's
};

/// A fit beside the noise of its inputs, where it ended.
struct FitBesideNoise {
  const InPlantSetup& setup;
  const std::vector<PlantRecording>& recordings;
  const LeastSquaresProblem& problem;
  std::span<const double> x;
  const PlantCases& as_measured;
  PlantCases& cases;  ///< those of the residuals, without the likely noise of the inputs
  const PlantResiduals& residuals;
  const std::vector<RecordingNoise>& noise;  ///< of each recording, from these sources
  const NoiseSources& sources;
  double force = 0;  ///< N: of the dampers, its size
  int threads = 0;
};

/// Where a number of the plant differs from that beside the law by more than chance (5 % in all),
/// the numbers beside any force; nothing else. `end` and `beside_law` are of the fit at x.
std::optional<BesideAnyForce> beside_any_force(const FitBesideNoise& fit, EndOfSearch end,
                                               const Jackknife& beside_law);

/// How far an interval of this half reaches below and above, where the number goes this way and is
/// known there within another half.
std::pair<double, double> reach_to(double half, double way, double half_there);

/// The plant's numbers there, with their intervals.
std::vector<FittedParameter> numbers_beside_any_force(const BesideAnyForce& found,
                                                      const FitBesideNoise& fit);
/// The same in words, and how much of an interval comes from it.
std::string told_beside_any_force(const BesideAnyForce& found, const FitBesideNoise& fit,
                                  const Jackknife& beside_law);

}  // namespace dashpot
