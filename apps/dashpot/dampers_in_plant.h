#pragma once
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/machine/observe.h"

namespace dashpot::cli {

class Console;

/// What a text says of each damper, in the order of the plant's struts: one `value` for all of
/// them, or NAME=VALUE of each strut or kind of damper, separated by commas. Throws UsageError of
/// this option where a damper has none or two, or is not there.
std::vector<std::string> of_each_damper(const std::string& text, const InPlantSetup& setup,
                                        const std::string& option, const std::string& value);

/// MODEL: a model file for all dampers of a plant, or one each.
Option model_of_each_option(std::string& target);

/// A model file per damper: MODEL is one for all of them, where they are alike, or one of each.
std::vector<std::string> model_files(const std::string& model, const InPlantSetup& setup);

/// The dampers in a plant by their files, each of which is read once. The setup gets the noise
/// that they know of.
ObservedDampers load_dampers(const std::vector<std::string>& files, const std::string& command,
                             InPlantSetup& setup, Console& console);

}  // namespace dashpot::cli
