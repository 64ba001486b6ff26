#include "dashpot/numerics/interval.h"

#include "dashpot/base/random.h"
#include "dashpot/numerics/summed.h"
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

TEST_CASE("sums enclose exact ones of which next to nothing is left") {
  Random random(2);
  const auto some = [&] { return std::exp(10 * random.normal()) * (random.uniform() - 0.5); };
  long missed_by_doubles = 0;
  for (int k = 0; k < 2000; ++k) {
    // 30 products of three factors, one of them known by an interval, and their opposite, in
    // another order.
    Summed sum;
    long double exact = 0;
    std::vector<std::array<double, 3>> terms;
    for (int i = 0; i < 30; ++i) terms.push_back({some(), some(), some()});
    const auto add = [&](const std::array<double, 3>& of, double sign) {
      const Interval known = Interval(of[0]) / of[1];
      sum += scaled(3, Summed(known) * of[2]) * sign;
      exact += 3.0L * sign * of[0] / of[1] * of[2];
    };
    for (const auto& term : terms) add(term, 1);
    std::ranges::reverse(terms);
    terms.resize(29);
    for (const auto& term : terms) add(term, -1);

    const Interval is = sum.interval();
    CHECK(is.low <= exact);
    CHECK(exact <= is.high);
    missed_by_doubles += std::abs(sum.value - static_cast<double>(exact)) > 0x1p-57 * sum.size;
  }
  CHECK(missed_by_doubles > 20);

  // A width beyond rounding stays.
  const Interval wide = Summed(Interval(1, 3)).interval();
  CHECK(wide.low <= 1);
  CHECK(wide.high >= 3);
}
