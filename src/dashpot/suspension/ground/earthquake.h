#pragma once
#include <filesystem>
#include <string_view>

#include "dashpot/ground_motion.h"

namespace dashpot {

/// A record of ground acceleration: a file with two columns, time and acceleration, at equal steps.
/// `unit` of the acceleration goes before the one that the column names ("acc (g)"); without either
/// it is in m/s^2, and the description says so beside the greatest acceleration. time_scale: a
/// model building of a fifth of the size shakes five times as fast: 0.2. Throws Error with what is
/// missing.
GroundPointer load_earthquake(const std::filesystem::path& path, std::string_view unit = {},
                              double time_scale = 1);

}  // namespace dashpot
