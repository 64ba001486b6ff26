#pragma once
#include <string>

#include "command.h"

namespace dashpot::cli {

class Console;

/// --list, of the commands of the suspension: what there is to choose from.
Option list_option(std::string& kind);

/// Lists plants, dampers, controllers or roads, each with the settings that it takes.
void print_list(const std::string& kind, Console& console);

}  // namespace dashpot::cli
