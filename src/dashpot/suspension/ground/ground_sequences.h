#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "dashpot/record/excitation.h"
#include "dashpot/suspension/ground/ground_motion.h"

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

/// From a text like "iso8608,class=C,speed=72km/h" or "step,height=3cm"; "class=C" stands for the
/// roughness of that class. A file's: "measured,file=road.txt,speed=72km/h" or
/// "earthquake,file=el_centro.dat,unit=g0", as recorded_grounds() has them. Throws Error(where,
/// ...) on an unknown name or parameter and on a value that is out of bounds.
GroundPointer make_ground(const std::string& text, std::uint64_t seed,
                          const std::string& where = "road");

}  // namespace dashpot
