#include "dashpot/numerics/interval.h"

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("intervals enclose what numbers inside them give, in more digits") {
  Random random(1);
  const auto some = [&] { return std::exp(10 * random.normal()) * (random.uniform() - 0.5); };
  const auto holds = [](const Interval& interval, long double value) {
    return interval.low <= value && value <= interval.high;
  };
  for (int k = 0; k < 20000; ++k) {
    const double a = some(), b = some(), c = some();
    const Interval x = a, y = b, z = c;
    const long double p = a, q = b, r = c;
    CHECK(holds(x + y * z, p + q * r));
    CHECK(holds((x - y) * (x + z), (p - q) * (p + r)));
    CHECK(holds(x * y - z / x, p * q - r / p));

    // Of wide ones, each end and the middle.
    const Interval wide{std::min(a, b), std::max(a, b)};
    for (const long double inside : {p, q, (p + q) / 2}) {
      CHECK(holds(wide * z, inside * r));
      CHECK(holds(wide * wide, inside * inside));
      CHECK(holds(z - wide, r - inside));
    }
  }
  CHECK(holds(Interval(1e-300) * 1e-300, 1e-300L * 1e-300L));  // below the least double
}
