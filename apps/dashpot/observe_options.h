#pragma once
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/machine/observer_tables.h"

namespace dashpot::cli {

/// --force-error, which several commands have.
Option force_error_option(std::vector<std::string>& words);
/// --velocity-shift, likewise.
Option velocity_shift_option(std::string& word);
/// "30@0.01,50@1": standard deviations in N and how soon each is forgotten, s. Throws UsageError.
std::vector<ForceError> force_errors(const std::vector<std::string>& words);
/// "0.004@0.015": a standard deviation in m/s and how soon it is forgotten, s; empty: none. Throws
/// UsageError.
VelocityShift velocity_shift(const std::string& word);

}  // namespace dashpot::cli
