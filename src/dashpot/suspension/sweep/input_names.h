#pragma once
#include <string>

#include "dashpot/suspension/sweep/request.h"

namespace dashpot {

/// What varies under that name: "sprung_mass" of the plant, "road.speed", "damper.damping",
/// "mix1.crossover" of a controller, "current". Reads how. The request's controllers and road are
/// there already. Throws Error that names file and line.
SweepInput read_sweep_input(const std::string& name, const Value& value,
                            const SweepRequest& request, bool on_grid);

}  // namespace dashpot
