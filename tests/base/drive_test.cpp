#include "dashpot/drive.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("the drive of a damper is read and written by its unit") {
  for (const DriveUnit unit : {DriveUnit::None, DriveUnit::Ampere, DriveUnit::Volt})
    CHECK(parse_drive_unit(name_of(unit), "model.json") == unit);
  CHECK(name_of(DriveUnit::None) == "none");
  CHECK(to_string(DriveUnit::None).empty());
  CHECK(drive_channel(DriveUnit::Ampere) == "current");
  CHECK(drive_channel(DriveUnit::Volt) == "voltage");
  CHECK(
      message_of([] { parse_drive_unit("mA", "model.json, drive_unit"); }) ==
      "model.json, drive_unit: drive unit 'mA' is unknown; write A (current), V (voltage) or none");
}
