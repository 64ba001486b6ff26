#include "dashpot/drive.h"

#include <array>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

const std::string& to_string(DriveUnit unit) {
  static const std::array<std::string, 3> kUnits{"", "A", "V"};
  return kUnits[static_cast<std::size_t>(unit)];
}

const std::string& unit_of(DriveUnit unit) {
  static const std::string kNumber = "1";
  return unit == DriveUnit::None ? kNumber : to_string(unit);
}

const std::string& name_of(DriveUnit unit) {
  static const std::string kNone = "none";
  return unit == DriveUnit::None ? kNone : to_string(unit);
}

DriveUnit parse_drive_unit(std::string_view text, const std::string& where) {
  for (const DriveUnit unit : {DriveUnit::None, DriveUnit::Ampere, DriveUnit::Volt})
    if (text == name_of(unit)) return unit;
  throw Error(where, "drive unit '" + std::string(text) + "' is unknown",
              "write A (current), V (voltage) or none");
}

const std::string& drive_channel(DriveUnit unit) {
  static const std::string kCurrent = "current", kVoltage = "voltage";
  return unit == DriveUnit::Volt ? kVoltage : kCurrent;
}

std::string beyond_known_text(double greatest, double known, DriveUnit unit) {
  if (!(greatest > known * (1 + 1e-9))) return {};
  const std::string counted = unit == DriveUnit::None ? "" : ' ' + to_string(unit);
  return "a greatest drive of " + format_number(greatest) + counted +
         " is beyond what the damper is known for, " + format_number(known) + counted +
         ": there its model extrapolates";
}

}  // namespace dashpot
