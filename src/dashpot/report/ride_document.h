#pragma once
#include "dashpot/report/document.h"
#include "dashpot/suspension/ride/ride_study.h"

namespace dashpot {

/// Tables against passive, gain curves with the one-sensor paper's limits, trade-off of comfort and
/// road holding, time traces.
Document ride_document(const RideStudy& study);
Value ride_json(const RideStudy& study);

}  // namespace dashpot
