#include "commands.h"

namespace dashpot::cli {

std::vector<Command> all_commands() {
  return {identify_command(), evaluate_command(), inspect_command(),    models_command(),
          bench_command(),    demo_command(),     completion_command(), version_command()};
}

}  // namespace dashpot::cli
