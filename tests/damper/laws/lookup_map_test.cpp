#include "dashpot/damper/laws/lookup_map.h"

#include "support.h"

namespace {
constexpr LookupMap kMap{.p1 = 10,
                         .p2 = 30,
                         .p3 = 40,
                         .p4 = 60,
                         .p5 = 100,
                         .p6 = 180,
                         .n1 = -1,
                         .n2 = -2,
                         .n3 = -4,
                         .n4 = -8,
                         .n5 = -16,
                         .n6 = -8,
                         .v_max = 0.32,
                         .f0 = 5};
double force(double v) { return lookup_map_force(&kMap, 0, v, nullptr); }
}  // namespace

TEST_CASE("the map passes through its knots and is straight between them") {
  CHECK(force(0) == 5);
  const double speed[] = {0.01, 0.02, 0.04, 0.08, 0.16, 0.32};
  const double pull[] = {10, 30, 40, 60, 100, 180}, push[] = {-1, -2, -4, -8, -16, -8};
  for (int k = 0; k < 6; ++k) {
    CHECK_CLOSE(force(speed[k]), 5 + pull[k], 1e-12, 0);
    CHECK_CLOSE(force(-speed[k]), 5 + push[k], 0, 1e-12);
    const double before = k ? speed[k - 1] : 0;
    CHECK_CLOSE(force((speed[k] + before) / 2), 5 + (pull[k] + (k ? pull[k - 1] : 0)) / 2, 1e-12,
                0);
  }
}

TEST_CASE("beyond its last knot the map goes on, but never falls") {
  CHECK_CLOSE(force(0.48), 5 + 180 + 80, 1e-12, 0);
  CHECK_CLOSE(force(-0.48), 5 - 8, 0, 1e-12);
}
