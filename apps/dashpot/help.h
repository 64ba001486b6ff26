#pragma once
#include <string>
#include <vector>

#include "command.h"

namespace dashpot::cli {

/// The overview that `dashpot` without arguments prints.
std::string overview(const std::vector<Command>& commands, const Console& console);

/// The text of `dashpot COMMAND --help`, under 60 lines at 80 columns: all that there is to say
/// where that fits, else what most users need and the names of topics with the rest. `common`: the
/// options that every command has.
std::string command_help(const Command& command, const std::vector<Option>& common,
                         const Console& console);

/// The text of `dashpot help COMMAND WORD`: a topic, one option, or everything for "all". Throws
/// UsageError that names the topics.
std::string help_on(const std::string& word, const Command& command,
                    const std::vector<Option>& common, const Console& console);

/// All of it as a page of the documentation.
std::string help_markdown(const std::vector<Command>& commands, const std::vector<Option>& common);

}  // namespace dashpot::cli
