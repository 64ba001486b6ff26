#pragma once
#include <vector>

#include "dashpot/damper/kinds/family/family_force.h"
#include "dashpot/damper/kinds/family/presets.h"
#include "dashpot/identify/fit/family_record.h"
#include "dashpot/monitor.h"

namespace dashpot {

/// The fitted gates with the spread of dampers that their fit found.
struct FamilyGatesFit {
  FamilyGates gates;
  double build_spread = 0;  ///< from designs that were left out; 0 where there is one
  double spread_low = 0, spread_high = 0;  ///< its 95 % interval
};

/// Ridge regression, whose strengths come from leaving designs out of these records: a design is
/// all dampers of one geometry, or of one fluid where there is one geometry. The offset of a record
/// is not a nuisance here. Throws Error where nothing moves, or the records do not determine the
/// weights.
FamilyGatesFit fit_family_gates(const FamilyPreset& preset,
                                const std::vector<FamilyRecord>& records, const Monitor& monitor);

}  // namespace dashpot
