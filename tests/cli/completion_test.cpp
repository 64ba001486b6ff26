#include "program.h"

namespace {

bool is_installed(const std::string& shell) {
  if (run_program("command -v " + shell).exit_code == 0) return true;
  MESSAGE("SKIPPED: " << shell << " is not installed");
  return false;
}

/// What bash offers for the last of these words.
std::string bash_completion(const std::string& words, int count) {
  const TemporaryFolder folder;
  const std::filesystem::path script =
      folder.write("try.bash", "source <(" + program_path() + " completion bash)\nCOMP_WORDS=(" +
                                   words + ")\nCOMP_CWORD=" + std::to_string(count - 1) +
                                   "\n_dashpot\necho \"${COMPREPLY[@]}\"\n");
  return run_program("bash " + script.string()).output;
}

}  // namespace

TEST_CASE("the completion scripts are valid in their shells") {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    CAPTURE(shell);
    const ProgramResult script = run_dashpot("completion " + shell);
    CHECK(script.exit_code == 0);
    CHECK(contains(script.output, "identify"));
    if (!is_installed(shell)) continue;
    const ProgramResult parsed =
        run_program("( " + program_path() + " completion " + shell + " | " + shell + " -n )");
    CAPTURE(parsed.output);
    CHECK(parsed.exit_code == 0);
    CHECK(parsed.output.empty());
  }
}

TEST_CASE("bash completes commands, options, models and lists of them" *
          doctest::test_suite("long")) {
  CHECK(bash_completion("dashpot ide", 2) == "identify identify-many\n");
  CHECK(bash_completion("dashpot identify --leave", 3) == "--leave-out\n");
  CHECK(bash_completion("dashpot models bing", 3) == "bingham\n");
  CHECK(bash_completion("dashpot identify --models bing", 4) == "bingham\n");
  CHECK(bash_completion("dashpot identify --models bingham,tanh_k", 4) == "bingham,tanh_kwok\n");
  CHECK(bash_completion("dashpot completion z", 3) == "zsh\n");
  CHECK(bash_completion("dashpot study one", 3) == "one-sensor\n");
  CHECK(bash_completion("dashpot study recovery --rep", 4) == "--repetitions\n");
}
