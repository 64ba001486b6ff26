#pragma once
#include <string>
#include <vector>

#include "dashpot/design/design_problem.h"

// The limits of models that were fitted on dampers: beyond these they extrapolate.
namespace dashpot {

/// The request, which asks moreover that no design lies beyond the dampers of a fitted model.
DesignRequest within_families(DesignRequest request, const DesignModel& first,
                              const DesignModel* second);

/// Currents and speeds at which a force is asked, and which the model has not seen; each once, in
/// words.
std::vector<std::string> operations_beyond(const DesignRequest& request, const DesignModel& model);

/// Variables that move the force by first principles, but not by this model: it reads the current,
/// say, and not the turns of the coil. Seen from the middle of the ranges.
std::vector<std::string> unseen_fields(const DesignProblem& problem, const DesignModel& model);

}  // namespace dashpot
