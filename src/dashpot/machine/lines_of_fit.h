#pragma once
#include <optional>
#include <span>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/input_noise.h"
#include "dashpot/machine/plant_residuals.h"
#include "dashpot/numerics/jackknife.h"
#include "dashpot/numerics/least_squares.h"

namespace dashpot {

// What a fit beside the noise of its inputs (beside_noise.h) leaves at each frequency, and what
// pieces of time tell by it.

/// Each recording in free run about x, and what it shows beyond its sensors.
std::vector<InPlantTrace> traces_at(const PlantResiduals& residuals, std::span<const double> x,
                                    int threads);

/// The noise of each recording about these traces; empty where a motion tells no spring from a
/// dashpot.
std::vector<RecordingNoise> noise_about(const InPlantSetup& setup, const PlantCases& cases,
                                        const std::vector<InPlantTrace>& traces, int threads);

/// The recordings with inputs from which the likely noise of their sensors is taken.
PlantCases without_noise(const PlantCases& as_measured, const InPlantSetup& setup,
                         const std::vector<PlantRecording>& recordings,
                         const std::vector<RecordingNoise>& noise, int threads);

/// Takes from what was measured what the noise of the inputs shows in the model: so the residuals
/// stay those of the inputs as they were measured, and the sensitivities are those without noise.
void keep_residuals(const std::vector<InPlantTrace>& as_measured,
                    const std::vector<InPlantTrace>& without, PlantCases& cases);

/// The columns and residuals of a problem at the end of its search.
struct EndOfSearch {
  std::vector<double> residuals;
  std::vector<std::vector<double>> columns;  ///< empty: of an unknown that is fixed
};
/// Nothing where the plant diverges at x.
std::optional<EndOfSearch> end_of(const LeastSquaresProblem& problem, std::span<const double> x);

/// What pieces of time tell, in which what was left is known: some 24 in all, of about the same
/// length, two of a recording at least.
std::vector<BlockOfData> pieces_of(const EndOfSearch& end, const std::vector<RecordingNoise>& noise,
                                   int threads);

}  // namespace dashpot
