#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "dashpot/ground_motion.h"
#include "dashpot/record/excitation.h"

namespace dashpot {

/// A road or another motion of the ground, known by name.
struct GroundSequence {
  SequenceInfo info;
  GroundPointer (*make)(std::span<const double> values, std::uint64_t seed);
};
/// In alphabetical order.
std::span<const GroundSequence> ground_sequences();

/// Throws Error "unknown motion of the ground ...; did you mean ...".
const GroundSequence& find_ground_sequence(std::string_view name, const std::string& where = {});

}  // namespace dashpot
