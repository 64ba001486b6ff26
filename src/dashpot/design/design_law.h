#pragma once
#include "dashpot/design/design_problem.h"
#include "dashpot/model_file.h"

namespace dashpot {

/// A design as a force law that every other command understands.
struct DesignLaw {
  ModelFile file;        ///< its provenance names the request; command and date are the caller's
  double rms_error = 0;  ///< N, of the law against the design's model over the grid of the fit
  double largest_force = 0;  ///< N, of the grid
};

/// Fits plate_bingham, its damping linear in the current and its yielding force exponential or
/// cubic, whichever is nearer, to the model's forces at all speeds and currents that the request
/// names (1 A and 0.5 m/s where it names none). The coil's time constant at the largest current
/// becomes the law's lag.
DesignLaw law_of_design(const DamperDescription& damper, const DesignRequest& request,
                        const DesignModel& model);

}  // namespace dashpot
