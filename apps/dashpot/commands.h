#pragma once
#include <vector>

#include "command.h"

namespace dashpot::cli {

Command identify_command();
Command identify_many_command();
Command observe_command();
Command watch_command();
Command rank_command();
Command search_command();
Command evaluate_command();
Command member_command();
Command models_command();
Command inspect_command();
Command characterise_command();
Command compare_command();
Command track_command();
Command export_command();
Command invert_command();
Command physics_command();
Command design_command();
Command simulate_command();
Command ride_command();
Command sweep_command();
Command studio_command();
Command merge_command();
Command bench_command();
Command demo_command();
Command study_command();
Command completion_command();
Command version_command();

/// Every command, in the order of the overview.
std::vector<Command> all_commands();

/// The options that every command has besides its own.
std::vector<Option> common_options(Console& console);

}  // namespace dashpot::cli
