#include "dashpot/numerics/non_negative.h"

#include "dashpot/base/random.h"
#include "dashpot/numerics/linear_algebra.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("an unknown that would be negative is 0, and the others are found without it") {
  // The least of (x0 + x1 - 1)^2 + (x1 + 1)^2 is at x = (2, -1); with x1 = 0 at x0 = 1.
  const std::vector<double> x =
      solve_non_negative(std::vector<double>{1, 1, 1, 2}, std::vector<double>{1, 0});
  CHECK_CLOSE(x[0], 1, 1e-9, 0);
  CHECK(x[1] == 0);
}

TEST_CASE("what is found is the least: no slope downwards is left, none upwards is used") {
  // Problems with 12 unknowns from 9 rows, so that some say the same as others together.
  constexpr std::size_t kUnknowns = 12, kRows = 9;
  Random random(3);
  for (int problem = 0; problem < 50; ++problem) {
    std::vector<double> rows(kRows * kUnknowns), wanted(kRows);
    for (double& value : rows) value = random.normal();
    for (double& value : wanted) value = random.normal();
    std::vector<double> matrix(kUnknowns * kUnknowns), right(kUnknowns);
    for (std::size_t r = 0; r < kRows; ++r)
      for (std::size_t i = 0; i < kUnknowns; ++i) {
        right[i] += rows[r * kUnknowns + i] * wanted[r];
        for (std::size_t k = 0; k < kUnknowns; ++k)
          matrix[i * kUnknowns + k] += rows[r * kUnknowns + i] * rows[r * kUnknowns + k];
      }

    const std::vector<double> x = solve_non_negative(matrix, right);
    const std::vector<double> there = product(matrix, x, kUnknowns);
    for (std::size_t k = 0; k < kUnknowns; ++k) {
      CAPTURE(problem);
      CHECK(x[k] >= 0);
      CHECK(right[k] - there[k] < 1e-6);
      CHECK(std::abs(x[k] * (right[k] - there[k])) < 1e-6);
    }
  }
}
