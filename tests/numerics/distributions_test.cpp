#include "dashpot/numerics/distributions.h"

#include "support.h"

using namespace dashpot;

// Expected values: tables of any book of statistics, to more digits by hand where stated.

TEST_CASE("distributions: quantiles of the normal and of Student's t") {
  CHECK_CLOSE(normal_quantile(0.975), 1.959963984540054, 1e-15, 0);
  CHECK_CLOSE(normal_quantile(0.5), 0, 0, 1e-16);
  CHECK_CLOSE(normal_quantile(1e-10), -6.361340902404056, 1e-14, 0);
  CHECK_CLOSE(students_t_quantile(4, 0.95), 2.131846786326649, 1e-13, 0);
  CHECK_CLOSE(students_t_quantile(1, 0.75), 1, 1e-14, 0);  // Cauchy's: tan(pi (p - 1/2))
}

TEST_CASE("distributions: ten tosses of a coin") {
  const Binomial tosses{10, 0.5};
  CHECK_CLOSE(tosses.at_most(5), 638.0 / 1024, 1e-15, 0);
  CHECK_CLOSE(tosses.at_most(0), 1.0 / 1024, 1e-15, 0);
  CHECK(tosses.quantile(0.05) == 1);
  CHECK(tosses.quantile(0.95) == 8);
}
