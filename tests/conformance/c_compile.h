#pragma once
#include "support.h"

inline bool is_there(const std::string& program) {
  if (run_program(program + " --version").exit_code == 0) return true;
  MESSAGE("SKIPPED: no " << program << " is here");
  return false;
}

/// Compiles all C in the folder, NAME.c with NAME_test.c, and runs the tests. What fails is printed.
inline ProgramResult compile_and_run(const TemporaryFolder& folder, const std::string& flags) {
  folder.write(
      "check",
      "cc -std=c99 -pedantic -Wall -Wextra -Wshadow -Wfloat-conversion -Werror " + flags +
          " -c $1.c -o $1.o 2> $1.out && cc -std=c99 -w $1_test.c $1.o -lm -o $1 && ./$1 > $1.out || "
          "{ echo \"FAILED $1\"; head -5 $1.out; exit 1; }\n");
  return run_program("cd '" + folder.path().string() +
                     "' && ls *_test.c | sed 's/_test.c//' | xargs -P $(nproc) -I NAME sh check NAME");
}
