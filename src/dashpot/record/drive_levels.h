#pragma once
#include <span>

#include "dashpot/record.h"

namespace dashpot {

/// Finds the level of each record whose drive was recorded and is constant, A or V: where no level
/// is known already and the samples move by no more than a sensor's noise. Levels are rounded to
/// steps in which people set them.
///
/// Noise is 0.02 or 5 % of the level, steps are hundredths. Where no sample of all records reaches
/// 0.5, both go with the largest sample, of which they are 1/25 and at most 1/50: a damper that is
/// driven by 25 mA has levels of 0.5 mA. A drive below 0.005 is taken as the noise of a zero, and
/// so is one whose quietest record moves by more than a quarter of the largest sample, unless all
/// of them stay on one side of zero and move slowly, as a source drives them.
void find_drive_levels(std::span<Record> records);

}  // namespace dashpot
