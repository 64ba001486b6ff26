#include "dashpot/suspension/sweep/statistics.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("quantiles with the ranks that tables of order statistics give") {
  std::vector<double> values(100);
  std::iota(values.begin(), values.end(), 1.0);
  const Quantile median = quantile_of(values, 0.5);
  CHECK(median.value == 50.5);
  // 95 % for the median of 100 values: the 40th to the 61st (Conover, Practical Nonparametric
  // Statistics)
  CHECK(median.low == 40);
  CHECK(median.high == 61);
  CHECK(quantile_of(values, 0.05).value == 5.95);  // as numpy.percentile(range(1, 101), 5)
  // Five values hold the median with 1 - 2/32 < 95 %, six with 1 - 2/64 > 95 %.
  CHECK(!quantile_of(std::vector<double>{1, 2, 3, 4, 5}, 0.5).low);
  CHECK(quantile_of(std::vector<double>{1, 2, 3, 4, 5, 6}, 0.5).low == 1);
  CHECK(quantile_of(std::vector<double>{1, 2, 3, 4, 5, 6}, 0.5).high == 6);
  CHECK(!quantile_of(std::vector<double>{1, 2, 3, 4, 5, 6}, 0.95).high);
  CHECK(quantile_of(std::vector<double>{7}, 0.5).value == 7);
}

TEST_CASE("the intervals hold as often as they say") {
  Random random(3);
  int held = 0, all = 0;
  for (int k = 0; k < 2000; ++k, ++all) {
    std::vector<double> values;
    for (int i = 0; i < 120; ++i) values.push_back(random.uniform());
    const Quantile q = quantile_of(sorted_finite(values), 0.25);
    REQUIRE((q.low && q.high));
    held += *q.low <= 0.25 && *q.high >= 0.25;
  }
  CHECK(held >= 0.94 * all);
  CHECK(held <= 0.98 * all);  // ranks are whole: a little wider than 95 %
}

TEST_CASE("what is not finite does not count") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto spread = spread_of({none, 3, 1, INFINITY, 2});
  REQUIRE(spread);
  CHECK(spread->count == 3);
  CHECK(spread->mean == 2);
  CHECK(spread->deviation == 1);
  CHECK(!spread_of({none}));
}

TEST_CASE("rank correlation with the value that SciPy prints for its example") {
  const std::vector<double> x{1, 2, 3, 4, 5}, y{5, 6, 7, 8, 7};
  CHECK_CLOSE(rank_correlation(x, y).value(), 0.82078268166812329, 1e-12, 0);
  CHECK_CLOSE(rank_correlation(x, std::vector<double>{25, 16, 9, 4, 1}).value(), -1, 1e-12, 0);
  CHECK(!rank_correlation(x, std::vector<double>(5, 2.0)));
  CHECK(!rank_correlation(x, std::vector<double>{1, 2, NAN, NAN, NAN}));
  CHECK_CLOSE(chance_correlation(101), 0.1959964, 1e-6, 0);
}
