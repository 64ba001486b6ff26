#include "commands.h"

#include "console.h"

namespace dashpot::cli {

std::vector<Command> all_commands() {
  return {identify_command(), rank_command(),       search_command(),       identify_many_command(),
          evaluate_command(), inspect_command(),    characterise_command(), compare_command(),
          models_command(),   member_command(),     physics_command(),      design_command(),
          invert_command(),   track_command(),      observe_command(),      watch_command(),
          simulate_command(), ride_command(),       sweep_command(),        merge_command(),
          study_command(),    export_command(),     studio_command(),       bench_command(),
          demo_command(),     completion_command(), version_command()};
}

std::vector<Option> common_options(Console& console) {
  return {{.names = "--json",
           .target = &console.json,
           .help = "the result as JSON on stdout; all else on stderr"},
          {.names = "-q,--quiet",
           .target = &console.quiet,
           .help = "no progress and no notes on stderr"},
          {.names = "--progress",
           .target = &console.progress,
           .help = "progress on stderr",
           .value = "FORMAT",
           .choices = {"text", "json"},
           .details = ": for people, or as lines of JSON"}};
}

}  // namespace dashpot::cli
