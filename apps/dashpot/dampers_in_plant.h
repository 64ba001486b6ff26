#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/observe.h"

namespace dashpot::cli {

class Console;

/// A model file per damper, in the order of the plant's struts: MODEL is one for all of them, or
/// says NAME=FILE of each. Throws UsageError where a damper has none or two, or is not there.
std::vector<std::string> model_files(const std::string& model,
                                     const std::vector<std::string>& struts);

/// The dampers in a plant by their files, each of which is read once. The setup gets the noise
/// that they know of.
ObservedDampers load_dampers(const std::vector<std::string>& files, const std::string& command,
                             InPlantSetup& setup, Console& console);

}  // namespace dashpot::cli
