#pragma once
#include "dashpot/machine/plant_advice.h"
#include "dashpot/report/document.h"

namespace dashpot::cli {

/// What would let the fit tell more, and the profiles of doubtful numbers: tables, a figure and
/// sentences of a section.
void add_advice(const PlantAdvice& advice, DocumentSection& section);

}  // namespace dashpot::cli
