#pragma once
#include <string>
#include <vector>

#include "command.h"

namespace dashpot::cli {

/// Fills the variables of `options` from a command's arguments (without program and command name).
/// Returns false when they ask for help instead. Throws UsageError.
bool parse_arguments(const std::string& command, const std::vector<Option>& options,
                     const std::vector<std::string>& arguments);

}  // namespace dashpot::cli
