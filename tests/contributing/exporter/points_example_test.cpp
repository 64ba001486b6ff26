#include <algorithm>

#include "dashpot/damper/law_list.h"
#include "export/example_models.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("the example exporter: its row is found, in its place, and writes every model") {
  const Exporter& exporter = find_exporter("points_example");
  CHECK(std::ranges::is_sorted(exporters(), {}, &Exporter::name));
  for (const ExampleModel& example : example_models()) {
    const auto files = exporter.write(exported(*example.model), {.name = example.name});
    REQUIRE(files.size() == 1);
    CHECK(files.front().name == example.name + "_points.txt");
    CHECK(std::ranges::count(files.front().content, '\n') == 2);
  }
}
