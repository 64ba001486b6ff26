#include "dashpot/numerics/root.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("root: found in few steps, also where one end would stay") {
  for (const double wanted : {1e-6, 2., 900.}) {
    int calls = 0;
    const auto cube = [&](double x) { return ++calls, x * x * x - wanted; };
    CHECK_CLOSE(find_root(cube, {0, -wanted}, {10, 1000 - wanted}, 1e-13 * wanted),
                std::cbrt(wanted), 1e-12, 0);
    CHECK(calls < 60);
  }
  CHECK(find_root([](double x) { return x; }, {-1, -1}, {0, 0}, 0) == 0);
}
