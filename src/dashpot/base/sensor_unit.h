#pragma once
#include "dashpot/base/units.h"

namespace dashpot {

/// parse_unit() of what a sensor shows, where no mass is measured: "g" and "G" are gravity's and no
/// gram, "mg" is a thousandth of it, "gal" is cm/s^2.
std::optional<Unit> parse_sensor_unit(std::string_view text);

}  // namespace dashpot
