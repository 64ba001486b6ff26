// Layer: base
#pragma once

// The quantity that drives a damper's coil, as a type: a current or a voltage.

#include <string>
#include <string_view>

namespace dashpot {

/// The quantity that drives a damper's coil, by its SI unit: a current or a voltage. It says what
/// the `current` of a DamperInput is and which channel of a Record holds it.
enum class DriveUnit {
  /// Nothing drives the damper, or a number from 0 to 1 without a unit does; of recordings: no
  /// channel tells the drive, which is taken as one constant, unknown one.
  None,
  Ampere,  ///< a current: channel "current"
  Volt     ///< a voltage: channel "voltage"
};

/// "A", "V", or "" for None. The string lives as long as the program.
const std::string& to_string(DriveUnit unit);
/// The same as a unit that other programs read, which know no empty one: "1" for None.
const std::string& unit_of(DriveUnit unit);
/// "A", "V", or "none" as files state it. The string lives as long as the program.
const std::string& name_of(DriveUnit unit);
/// The unit of that name. Throws Error(where, ...) on anything else.
DriveUnit parse_drive_unit(std::string_view text, const std::string& where);

/// The name of the channel, and the word for the quantity: "voltage" for Volt, else "current".
const std::string& drive_channel(DriveUnit unit);

/// What to say of a greatest drive beyond the one up to which a damper is known, both in this unit:
/// "a greatest drive of 9 A is beyond what the damper is known for, 1 A: there its model
/// extrapolates". Empty where it is within.
std::string beyond_known_text(double greatest, double known, DriveUnit unit);

}  // namespace dashpot
