#pragma once
#include <span>
#include <vector>

#include "dashpot/dataset.h"

namespace dashpot {

/// Repetitions that disagree: a record whose force has 1.3 times the size, or less than 1 / 1.3 of
/// it, that another has which moves as far and as fast (within 5 %) at the same constant drive and
/// under the same conditions. That is another damper, another load cell, gain or unit, or a current
/// that is not what was written down. Of three and more those are named that differ from the middle
/// one, of two the later one. Before them, copies: records whose force is that of another, sample
/// for sample.
std::vector<Suspect> doubts_about_repeats(std::span<const Record> records);

}  // namespace dashpot
