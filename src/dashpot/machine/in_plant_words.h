#pragma once
#include <string>
#include <string_view>

#include "dashpot/machine/in_plant.h"
#include "dashpot/value.h"

namespace dashpot {

/// A plant and its sensors in words: a file (a word with a dot or a slash), or for simple cases one
/// text, as
///   oscillator,mass=unknown,stiffness=5e4,force=excitation,displacement=x
/// in which parameters of the plant are known ("2 kg"), "unknown" or in a range ("300..500 kg"),
/// and inputs (force, ground, ground_acceleration) and sensors (displacement, velocity,
/// acceleration, deflection, deflection_velocity) name their channel, with "@body" where the plant
/// has several coordinates, "@front" where it has several struts or meets the road at several
/// places. current=CHANNEL, voltage=CHANNEL or current=1.5A drive the damper;
/// held_back, skip and start=rest stand as in a file.
///
/// A parameter that the plant's table does not have at 0 must be stated: nothing is guessed.
/// Throws Error at an unknown key or name, at a parameter that is missing.
InPlantSetup read_in_plant_setup(const std::string& words);
/// The same from the text of such a file; `source` stands in messages.
InPlantSetup parse_in_plant_setup(std::string_view text, const std::string& source);

/// The same setup as such a file holds it, in SI.
Value to_json(const InPlantSetup& setup);
/// The setup with what an identification has found in place of what was unknown: the plant's
/// numbers, where they are told those beside any force, and the sensors' delays; and beside what
/// was not stated: their noise.
InPlantSetup as_found(InPlantSetup setup, const InPlantReport& report);

}  // namespace dashpot
