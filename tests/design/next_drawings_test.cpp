#include "dashpot/design/next_drawings.h"

#include "damper/kinds/family/example_family.h"
#include "drawn_family.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Four drawings near the middle of the ranges, recorded.
std::vector<Record> recorded_middle(const DrawnFamily& family, Random& random) {
  std::vector<Record> records;
  DamperDescription drawing = drawn_family_request().damper;
  for (const double gap : {1.2e-3, 1.6e-3})
    for (const double length : {8e-3, 12e-3}) {
      drawing.gap = gap;
      drawing.pole_length = length;
      for (Record& record : recorded_drawing(family, drawing, random))
        records.push_back(std::move(record));
    }
  return records;
}

}  // namespace

TEST_CASE("the next drawings tell more than chance and a grid, and recorded they do no harm") {
  const DesignRequest request = drawn_family_request();
  const DrawnFamily family{.tests = {{{8e-3, 2}, 0}, {{8e-3, 2}, 1.5}}};
  Random random(1);
  std::vector<Record> records = recorded_middle(family, random);
  const auto before = fitted_drawings(records);
  REQUIRE(before);

  const NextOptions options{.count = 3, .tests = family.tests};
  const NextReport report = next_drawings(request, *before, options);
  REQUIRE(report.drawings.size() == 3);
  CHECK(report.drawings.front().band < report.before);
  CHECK(report.drawings[1].band < report.drawings.front().band);
  CHECK(report.drawings[2].band < report.drawings[1].band);
  CHECK(report.drawings[2].band < report.random);
  CHECK(report.drawings[2].band < report.grid);

  // All tests of a drawing, the last of which leaves the drawing's band.
  for (const NextDrawing& drawing : report.drawings) {
    require_possible(drawing.damper, "next");
    CHECK(drawing.tests.size() == family.tests.size());
    CHECK(std::ranges::is_sorted(drawing.band_after, std::greater()));
    CHECK_CLOSE(drawing.band_after.back(), drawing.band, 1e-9, 0);
    CHECK(!drawing.outside.empty());
  }

  // The same by any number of threads.
  NextOptions alone = options;
  alone.threads = 1;
  const NextReport again = next_drawings(request, *before, alone);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(again.drawings[k].band == report.drawings[k].band);
    CHECK(again.drawings[k].damper.gap == report.drawings[k].damper.gap);
  }

  // Recorded, they do not draw the family away from drawings that nobody has recorded. What four
  // drawings near the middle leave is the family's structure: nothing can be won there.
  constexpr double kByBuilds = 1.05;
  const DrawnFamily exact{.scatter = 0, .noise = 0, .tests = family.tests};
  std::vector<Record> elsewhere;
  for (const DamperDescription& drawing : random_drawings(request, 12, 5))
    for (Record& record : recorded_drawing(exact, drawing, random))
      elsewhere.push_back(std::move(record));
  for (const NextDrawing& drawing : report.drawings)
    for (Record& record : recorded_drawing(family, drawing.damper, random))
      records.push_back(std::move(record));
  const double left = share_of_force(*fitted_drawings(records), elsewhere);
  CHECK(left < kByBuilds * share_of_force(*before, elsewhere));
}

TEST_CASE(
    "a grid of drawings keeps within the ranges; more than there are, and a family that knows "
    "nothing of its recordings, are refused") {
  const DesignRequest request = drawn_family_request();
  const std::vector<DamperDescription> grid = grid_drawings(request, 16);
  REQUIRE(grid.size() == 16);
  CHECK_CLOSE(grid.front().gap, 1.01e-3, 1e-12, 0);
  CHECK_CLOSE(grid.back().bore_diameter, 37.75e-3, 1e-12, 0);
  CHECK(random_drawings(request, 7, 1).size() == 7);

  CHECK(contains(message_of([&] {
                   next_drawings(request, example_family_physics(),
                                 {.tests = drawn_family_tests()});
                 }),
                 "does not know what its recordings have told"));
}
