#include "dashpot/base/random.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("a seed gives the same numbers everywhere") {
  Random a(1), b(1), c(2);
  CHECK(a.next() == b.next());
  CHECK(a.next() != c.next());
}

TEST_CASE("moments of the normal and uniform numbers") {
  Random random(7);
  constexpr int kCount = 200000;
  double sum = 0, square = 0, fourth = 0, uniform = 0;
  for (int k = 0; k < kCount; ++k) {
    const double x = random.normal();
    sum += x, square += x * x, fourth += x * x * x * x;
    uniform += random.uniform(2, 4);
  }
  // four standard errors: 1/sqrt(n), sqrt(2/n), sqrt(96/n), (1/sqrt 3)/sqrt(n)
  CHECK_CLOSE(sum / kCount, 0, 0, 0.009);
  CHECK_CLOSE(square / kCount, 1, 0, 0.0127);
  CHECK_CLOSE(fourth / kCount, 3, 0, 0.088);
  CHECK_CLOSE(uniform / kCount, 3, 0, 0.0052);
}

TEST_CASE("an index stays below its count") {
  Random random(3);
  for (int k = 0; k < 1000; ++k) CHECK(random.index(3) < 3);
}
