#pragma once
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/base/print_units.h"

namespace dashpot::cli {

/// The row of the speeds at which forces are stated.
Option speeds_option(std::string& speeds);

/// "50,100,200" in the units of pages: m/s, ascending; empty stays empty. Throws UsageError on
/// anything else.
std::vector<double> parse_speeds(const std::string& text, const PrintUnits& units = {});

}  // namespace dashpot::cli
