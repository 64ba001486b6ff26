#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/record.h"

namespace dashpot {

/// What notes on suspect records begin with.
inline constexpr std::string_view kSuspectNote = "suspect: ";

/// What speaks against a record, each in words with its place: a channel that stands still while
/// the damper moves, a force that is clipped, single samples far from both neighbours, one value in
/// several samples far from all others, a last sample that leaps as where a file was cut off or a
/// first one, a channel that was sampled more slowly than the record and held, sizes that no MR
/// damper has (unit_doubts.h), a force that has lost its sign. Empty for a sound record. All other
/// thresholds are shares of the channel's own span, so that noise and the resolution of a sensor
/// raise none; an ideal dry friction without noise looks clipped.
std::vector<std::string> doubts_about(const Record& record);

}  // namespace dashpot
