#include <algorithm>
#include <filesystem>
#include <set>

#include "dashpot/damper/registry.h"
#include "support.h"

namespace fs = std::filesystem;

TEST_CASE("every law's header is C99: the text that the C export ships") {
  if (run_program("cc --version").exit_code != 0) {
    MESSAGE("SKIPPED: no C compiler is here");
    return;
  }
  std::set<std::string> headers;
  for (const auto& entry : fs::directory_iterator(project_file("src/dashpot/damper/laws"))) {
    if (entry.path().extension() != ".h") continue;
    headers.insert(entry.path().stem().string());
    const ProgramResult result =
        run_program("cc -std=c99 -pedantic -Wall -Wextra -Wshadow -Werror -fsyntax-only -x c '" +
                    entry.path().string() + "'");
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
  }
  for (const dashpot::Law* law : dashpot::laws()) CHECK(headers.count(std::string(law->name)));
  CHECK(headers.size() == dashpot::laws().size());
}
