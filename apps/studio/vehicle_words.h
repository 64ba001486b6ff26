#pragma once
#include <string>
#include <vector>

#include "dashpot/value.h"
#include "project.h"

namespace dashpot::studio {

/// What a page asks a vehicle to be, as options of `dashpot simulate` and `ride`:
///   {"plant": "savaresi_spelta", "values": "sprung_mass=350", "damper": "fits/x/models/y.json",
///    "settings": "motion_ratio=0.7", "controller": "mix1,crossover=2Hz", "current": 0.5,
///    "road": "iso8608,class=C", "duration": 10, "in_car": false}
/// Only "plant" and "road" must be there. Names are those that come with Dashpot, dampers may be
/// models of the project; settings hold numbers, units and words, and no path. Throws Error on all
/// else.
std::vector<std::string> vehicle_words(const Project& project, ObjectReader& asked);

/// One control law with its settings, as above. Throws Error where it is none.
void require_controller(const std::string& words);

}  // namespace dashpot::studio
