#pragma once
#include <cctype>
#include <cstdlib>

#include "support.h"

inline bool is_there(const std::string& program) {
  if (run_program(program + " --version").exit_code == 0) return true;
  MESSAGE("SKIPPED: no " << program << " is here");
  return false;
}

/// Of a compiler: looks for the mistakes that the build of the tests looks for.
#ifdef __SANITIZE_ADDRESS__
inline const std::string kAsTheTests =
    "-fsanitize=address,undefined -fno-sanitize-recover=undefined";
#else
inline const std::string kAsTheTests;
#endif

/// What runs programs of exported C: themselves, or valgrind and the like by DASHPOT_RUN_WITH.
inline std::string chosen_runner() {
  const char* runner = std::getenv("DASHPOT_RUN_WITH");
  return runner ? runner : "";
}

/// Compiles all C in the folder, NAME.c with NAME_test.c, and runs the tests. What fails is
/// printed. Both are one unit, which takes half the time of two; of the test, which stands in for
/// a header of the system then, no warnings are wanted.
inline ProgramResult compile_and_run(const TemporaryFolder& folder, const std::string& flags,
                                     const std::string& runner = chosen_runner()) {
  const std::string linker =
      run_program("command -v mold").exit_code == 0 ? "-fuse-ld=mold " : "";  // a tenth less time
  folder.write(
      "check",
      "printf '#pragma GCC system_header\\n#include \"%s_test.c\"\\n' $1 > $1_quiet.h\n"
      "printf '#include \"%s.c\"\\n#include \"%s_quiet.h\"\\n' $1 $1 > $1_both.c\n"
      "cc -std=c99 -pedantic -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion -Werror " +
          linker + flags + " $1_both.c -lm -o $1 > $1.out 2>&1 && " + runner +
          " ./$1 > $1.out 2>&1 || " + "{ echo \"FAILED $1\"; head -5 $1.out; exit 1; }\n");
  return run_program(
      "cd '" + folder.path().string() +
      "' && ls *_test.c | sed 's/_test.c//' | xargs -P $(nproc) -I NAME sh check NAME");
}

inline void check_that_it_runs(const TemporaryFolder& folder, const std::string& flags,
                               const std::string& runner = chosen_runner()) {
  const ProgramResult result = compile_and_run(folder, flags, runner);
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
}

/// What cppcheck's MISRA add-on says of a source is listed in its header.
inline void check_misra(const std::filesystem::path& source, const std::string& header) {
  const ProgramResult result = run_program(
      "cppcheck --addon=misra --quiet --enable=style --std=c99 '" + source.string() + "'");
  CAPTURE(result.output);
  CHECK(result.output.find("error:") == std::string::npos);
  for (std::size_t at = 0; (at = result.output.find("misra-c2012-", at)) != std::string::npos;
       ++at) {
    std::size_t end = at + 12;
    while (std::isdigit(static_cast<unsigned char>(result.output[end])) ||
           result.output[end] == '.')
      ++end;
    const std::string rule = result.output.substr(at + 12, end - at - 12);
    CAPTURE(rule);
    CHECK(header.find(' ' + rule) != std::string::npos);
  }
}
