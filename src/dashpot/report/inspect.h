#pragma once
#include <string>

#include "dashpot/dataset.h"

namespace dashpot {

/// What was understood of a dataset, as one self-contained page: every record with its channels in
/// time, F-v and F-x, and a measured velocity beside the one derived from displacement.
std::string inspect_html(const Dataset& dataset, const std::string& command,
                         const std::string& date);

}  // namespace dashpot
