// Layer: base
#pragma once

// The quantity that drives a damper's coil, as a type: a current or a voltage.

#include <string>
#include <string_view>

namespace dashpot {

/// The quantity that drives a damper's coil, by its SI unit: a current or a voltage. It says what
/// the `current` of a DamperInput is and which channel of a Record holds it.
enum class DriveUnit {
  None,    ///< nothing drives the damper, or a number from 0 to 1 without a unit does
  Ampere,  ///< a current: channel "current"
  Volt     ///< a voltage: channel "voltage"
};

/// "A", "V", or "" for None. The string lives as long as the program.
const std::string& to_string(DriveUnit unit);
/// "A" or "V" as files and arguments have it. Throws Error(where, ...) on anything else.
DriveUnit parse_drive_unit(std::string_view text, const std::string& where);

/// The name of the channel, and the word for the quantity: "voltage" for Volt, else "current".
const std::string& drive_channel(DriveUnit unit);

}  // namespace dashpot
