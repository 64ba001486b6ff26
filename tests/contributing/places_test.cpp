#include <map>
#include <sstream>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "support.h"

using namespace dashpot;

namespace {

using Places = std::vector<std::string>;

/// The places that a recipe of CONTRIBUTING.md promises: what stands first, in backquotes, in each
/// numbered line under its heading.
Places promised(const std::string& recipe) {
  std::istringstream text(read_file(project_file("CONTRIBUTING.md")));
  Places places;
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("## ")) inside = line == "## How to add " + recipe;
    const std::size_t first = line.find(". `");
    if (!inside || first == std::string::npos || first > 2) continue;
    places.push_back(line.substr(first + 3, line.find('`', first + 3) - first - 3));
  }
  return places;
}

}  // namespace

TEST_CASE("each recipe of CONTRIBUTING.md names the places that its example touches, no others") {
  std::map<std::string, Places> touched;
  std::istringstream lines(read_file(DASHPOT_PLACES));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t bar = line.find('|');
    touched[line.substr(0, bar)].push_back(line.substr(bar + 1));
  }
  CHECK(touched.size() == 6);
  for (const auto& [recipe, places] : touched) {
    CAPTURE(recipe);
    CHECK(promised(recipe) == places);
  }
}
