#pragma once
#include <filesystem>
#include <string_view>

#include "dashpot/ground_motion.h"

namespace dashpot {

/// A record of ground acceleration: a file with time in s and acceleration in `unit` ("": m/s^2;
/// "g0"), at equal steps. time_scale: a model building of a fifth of the size shakes five times as
/// fast: 0.2. Throws Error with what is missing.
GroundPointer load_earthquake(const std::filesystem::path& path, std::string_view unit = {},
                              double time_scale = 1);

}  // namespace dashpot
