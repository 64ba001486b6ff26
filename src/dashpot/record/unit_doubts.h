#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/record.h"

namespace dashpot {

/// Quantities of a size that no MR damper has, each in words with its column, what it would be in a
/// likelier unit and what to write where that is right: a current of 500 A, a stroke of 20 m, a
/// force of 1 N throughout, samples 5 s apart, a speed that the stroke has no room for. Empty where
/// every channel is of a usual size. The limits are generous: a unit that is wrong by a thousand is
/// beyond them for most dampers, one that is wrong by ten for few.
std::vector<std::string> doubts_about_units(const Record& record);

/// Records at several currents of which none is above some mA, read in another unit than A: most
/// likely it was A. A single record, or records at one level, may be at 0 A. Says so of the record
/// with the largest. So it does of currents that are negative in all records.
std::optional<Suspect> doubt_about_currents(std::span<const Record> records);

/// s between samples, from which on a motion of a damper is hardly followed.
inline constexpr double kLongestBetweenSamples = 0.5;

/// "ms", "us" or "ns": the first in which a step of so many s, kLongestBetweenSamples or more,
/// would be shorter.
std::string_view likelier_time_unit(double step);

}  // namespace dashpot
