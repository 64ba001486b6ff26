#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/ground_motion.h"

namespace dashpot {

/// A motion of the ground that comes from a file, known by name.
struct RecordedGround {
  struct Setting {
    std::string_view name, meaning,
        value;  ///< value: the default; empty: must be stated, or is found
  };
  std::string_view name, title, remarks;
  std::vector<Setting> settings;
  GroundPointer (*make)(std::span<const std::string> values, const std::string& where);
};
/// In alphabetical order.
std::span<const RecordedGround> recorded_grounds();

/// parts: the settings of "measured,file=road.txt,speed=72km/h". Throws Error(where, ...).
GroundPointer make_recorded_ground(const RecordedGround& kind, std::span<const std::string> parts,
                                   const std::string& where);

}  // namespace dashpot
