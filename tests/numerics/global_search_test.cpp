#include "dashpot/numerics/global_search.h"

#include <numbers>

#include "dashpot/error.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Rastrigin's function: about 100 local minima in this box, the least one 0 at the origin.
double rastrigin(std::span<const double> x) {
  double sum = 0;
  for (const double value : x)
    sum += 10 + value * value - 10 * std::cos(2 * std::numbers::pi * value);
  return sum;
}

const SearchBox kBox{{-5.12, -5.12}, {5.12, 5.12}};

}  // namespace

TEST_CASE("the least of many minima is found, the same at every run") {
  const auto found = global_search(rastrigin, kBox, {4, 3}, 3000, 1);
  CHECK_CLOSE(found[0], 0, 0, 0.1);
  CHECK_CLOSE(found[1], 0, 0, 0.1);
  CHECK(global_search(rastrigin, kBox, {4, 3}, 3000, 1) == found);
  CHECK(global_search(rastrigin, kBox, {4, 3}, 3000, 2) != found);
}

TEST_CASE("costs that cannot be computed are passed over; what a cost throws comes out") {
  const auto half = [](std::span<const double> x) { return x[0] < 1 ? NAN : x[0] + x[1] * x[1]; };
  const auto found = global_search(half, kBox, {4, 3}, 2000, 1);
  CHECK_CLOSE(found[0], 1, 0, 0.1);
  int calls = 0;
  const auto failing = [&](std::span<const double>) -> double {
    if (++calls == 50) throw Interrupted();
    return 1;
  };
  CHECK_THROWS_AS(global_search(failing, kBox, {4, 3}, 2000, 1), Interrupted);
  CHECK(calls == 50);
}
