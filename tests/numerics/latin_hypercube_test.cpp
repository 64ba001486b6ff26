#include "dashpot/numerics/latin_hypercube.h"

#include <set>

#include "support.h"

using namespace dashpot;

TEST_CASE("Latin hypercube: every part of every dimension has one point; the seed decides") {
  const auto points = latin_hypercube(50, 3, 7);
  REQUIRE(points.size() == 50);
  for (std::size_t d = 0; d < 3; ++d) {
    std::set<int> parts;
    for (const std::vector<double>& point : points) parts.insert(static_cast<int>(50 * point[d]));
    CHECK(parts.size() == 50);
    CHECK(*parts.begin() == 0);
    CHECK(*parts.rbegin() == 49);
  }
  CHECK(latin_hypercube(50, 3, 7) == points);
  CHECK(latin_hypercube(50, 3, 8) != points);
}
