#include "dashpot/drive.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("the drive of a damper is read and written by its unit") {
  for (const DriveUnit unit : {DriveUnit::Ampere, DriveUnit::Volt})
    CHECK(parse_drive_unit(to_string(unit), "model.json") == unit);
  CHECK(to_string(DriveUnit::None).empty());
  CHECK(drive_channel(DriveUnit::Ampere) == "current");
  CHECK(drive_channel(DriveUnit::Volt) == "voltage");
  CHECK(message_of([] { parse_drive_unit("mA", "model.json, drive_unit"); }) ==
        "model.json, drive_unit: drive unit 'mA' is unknown; write A (current) or V (voltage)");
}
