#include "dashpot/base/units.h"
#include "dashpot/dataset.h"
#include "dashpot/record/channel_names.h"
#include "dashpot/record/conditions.h"
#include "dashpot/record/excitation.h"
#include "dashpot/value.h"
#include "fuzz.h"

// Units, names of columns and files, and words about recordings; JSON and YAML below all files.

namespace {

void units(const std::string& input) {
  if (const auto unit = dashpot::parse_unit(input))
    require_true(unit->factor > 0 && std::isfinite(unit->factor) && std::isfinite(unit->offset));
  dashpot::recognise_channel(input, "");
}

void quantity(const std::string& input) {
  require_true(std::isfinite(dashpot::parse_quantity(input, "m/s", "fuzz")));
}

/// What was read is written, and reads back as the same text.
void json(const std::string& input) {
  const std::string text = dashpot::format_json(dashpot::parse_json(input, "fuzz.json"));
  require_true(dashpot::format_json(dashpot::parse_json(text, "again")) == text);
}

void yaml(const std::string& input) { dashpot::parse_yaml(input, "fuzz.yaml"); }

/// The text of what was understood is understood alike.
void leave_out(const std::string& input) {
  const std::string text = dashpot::format_leave_out(dashpot::parse_leave_out(input));
  require_true(dashpot::format_leave_out(dashpot::parse_leave_out(text)) == text);
}

void file_name(const std::string& input) {
  const dashpot::NameParts parts = dashpot::split_name(input);
  require_true(parts.rest.size() <= input.size() + 1);
}

void motion_words(const std::string& input) {
  const dashpot::PistonMotion motion = dashpot::make_motion(input, 1);
  for (const double t : {0.0, 0.1, motion.duration})
    require_true(std::isfinite(motion.at(t).displacement) && std::isfinite(motion.at(t).velocity));
}

void drive_words(const std::string& input) {
  const dashpot::DriveSignal drive = dashpot::make_drive(input, {0, 2.5, 10, 1});
  for (const double t : {0.0, 0.1, 10.0}) require_true(std::isfinite(drive.at(t)));
}

const FuzzTarget targets[] = {{"units", units},
                              {"quantity", quantity},
                              {"json", json},
                              {"yaml", yaml},
                              {"leave_out", leave_out},
                              {"file_name", file_name},
                              {"motion_words", motion_words},
                              {"drive_words", drive_words}};

}  // namespace
