#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "dashpot/record.h"

namespace dashpot {

/// A period of a signal: samples first ... first + count - 1.
struct Cycle {
  std::size_t first = 0, count = 0;
};

/// The complete cycles between successive upward crossings of zero. A crossing lies where the
/// straight line between two samples crosses; a cycle begins with the first sample behind it and
/// has as many samples as the time to the next crossing holds, rounded. Between two crossings the
/// signal must have been below zero by a tenth of its largest value, so that noise around zero is
/// no cycle.
std::vector<Cycle> find_cycles(std::span<const double> samples);

/// The last complete cycle of the motion, by its velocity: from one turning point at the lowest
/// displacement to the next. The beginning of a record may still be settling. Throws Error when
/// there is no whole cycle.
Record last_cycle(const Record& record);

}  // namespace dashpot
