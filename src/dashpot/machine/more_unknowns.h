#pragma once
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_advice.h"
#include "dashpot/numerics/least_squares.h"

namespace dashpot {

// Whether a fit inside a plant would leave clearly less if more were unknown than the plant says.

/// The setup with the delays that it does not state among the unknowns, of sensors whose filters
/// are known.
InPlantSetup with_delays_unknown(InPlantSetup setup);

/// The setup with filters of the second order in the place of the delays of these sensors, which
/// were found: their cut-offs are unknown, and looked for from where they come as late on.
InPlantSetup with_filters_for_delays(InPlantSetup setup, const std::vector<std::size_t>& sensors,
                                     const std::vector<FittedParameter>& nuisances);

/// What speaks for a fit once more, with more unknowns.
struct FitDoubts {
  bool is_late = false;     ///< delays that the plant does not state may take off much
  bool are_unlike = false;  ///< so may dampers that are not alike
  /// Sensors that are met better, to first order, behind filters than by the delays that were
  /// found.
  std::vector<std::size_t> as_if_filtered = {};
};

/// Those of a fit that has ended, to first order; whole: its problem there.
FitDoubts doubts_of(const EndedFit& fit, const LeastSquaresProblem& whole, int threads);

}  // namespace dashpot
