#pragma once
#include <string>
#include <vector>

#include "command.h"

namespace dashpot::cli {

/// The overview that `dashpot` without arguments prints.
std::string overview(const std::vector<Command>& commands, const Console& console);

/// The text of `dashpot COMMAND --help`. `common`: the options that every command has.
std::string command_help(const Command& command, const std::vector<Option>& common,
                         const Console& console);

/// All of it as a page of the documentation.
std::string help_markdown(const std::vector<Command>& commands, const std::vector<Option>& common);

/// "--starts N", "-q, --quiet", "DATA...".
std::string option_label(const Option& option);
/// The help text with its choices and default.
std::string option_text(const Option& option);

}  // namespace dashpot::cli
