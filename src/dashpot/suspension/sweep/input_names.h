#pragma once
#include <string>

#include "dashpot/suspension/sweep/request.h"

namespace dashpot {

/// Finds what a name means ("sprung_mass" of the plant, "road.speed", "damper.damping",
/// "mix1.crossover" of a controller, "current") and reads how it varies. The request must have its
/// controllers and its road. on_grid: a list of values, all of which are taken. Throws Error that
/// names file and line.
SweepInput read_sweep_input(const std::string& name, const Value& value,
                            const SweepRequest& request, bool on_grid);

}  // namespace dashpot
