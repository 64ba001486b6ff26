#pragma once
#include <string>
#include <vector>

namespace dashpot {

struct ChildResult {
  bool succeeded = false;
  std::string printed;  ///< on its standard output and error
};

/// Runs a program, found along PATH, with its arguments and waits for it. Throws Error(program,
/// ...) when it cannot be started.
ChildResult run_child(std::vector<std::string> program_and_arguments);

}  // namespace dashpot
