#pragma once
#include <string>

#include "dashpot/base/print_units.h"
#include "dashpot/dataset.h"

namespace dashpot {

/// As describe(dataset), with the records' extents in the units given.
std::string describe(const Dataset& dataset, const PrintUnits& units);

}  // namespace dashpot
