#pragma once
#include <string>
#include <vector>

#include "command.h"

namespace dashpot::cli {

/// The completion script of a shell ("bash", "zsh" or "fish"). `common`: the options of every
/// command.
std::string completion_script(const std::string& shell, const std::vector<Command>& commands,
                              const std::vector<Option>& common);

}  // namespace dashpot::cli
