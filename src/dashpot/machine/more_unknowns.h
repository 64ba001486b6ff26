#pragma once
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_advice.h"
#include "dashpot/numerics/least_squares.h"

namespace dashpot {

// Whether a fit inside a plant would leave clearly less if more were unknown than the plant says.

/// The setup with the delays that it does not state among the unknowns, of sensors whose filters
/// are known.
InPlantSetup with_delays_unknown(InPlantSetup setup);

/// What speaks for a fit once more, with more unknowns.
struct FitDoubts {
  bool is_late = false;     ///< delays that the plant does not state may take off much
  bool are_unlike = false;  ///< so may dampers that are not alike
};

/// Those of a fit that has ended, to first order; whole: its problem there.
FitDoubts doubts_of(const EndedFit& fit, const LeastSquaresProblem& whole, int threads);

}  // namespace dashpot
