#include "dashpot/numerics/median.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("the median is the number in the middle, of an even count the upper one") {
  CHECK(median({3, 1, 2}) == 2);
  CHECK(median({4, 1, 3, 2}) == 3);
  CHECK(median({7}) == 7);
  CHECK(median({}) == 0);
}
