#include "dashpot/numerics/symmetric.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("the inverse of a regular matrix is its inverse") {
  // [[2, 1], [1, 3]]: determinant 5, by hand.
  const SymmetricInverse result = invert_symmetric(std::vector<double>{2, 1, 1, 3}, 2);
  CHECK(result.weak.empty());
  const std::vector<double> expected{0.6, -0.2, -0.2, 0.4};
  for (std::size_t k = 0; k < 4; ++k) CHECK_CLOSE(result.inverse[k], expected[k], 1e-14, 0);
}

TEST_CASE("a direction without information is named and left out") {
  // a a' with a = (3, 4): pseudo-inverse a a' / |a|^4; nothing is known along (4, -3) / 5.
  const SymmetricInverse result = invert_symmetric(std::vector<double>{9, 12, 12, 16}, 2);
  REQUIRE(result.weak.size() == 1);
  CHECK_CLOSE(std::abs(result.weak[0][0]), 0.8, 1e-12, 0);
  CHECK_CLOSE(result.weak[0][0] * result.weak[0][1], -0.48, 1e-12, 0);
  CHECK_CLOSE(result.inverse[1], 12.0 / 625, 1e-12, 0);
  CHECK(invert_symmetric(std::vector<double>(4, 0.0), 2).weak.size() == 2);
}

TEST_CASE("a positive definite system is solved, another refused") {
  std::vector<double> x(2);
  CHECK(solve_positive_definite(std::vector<double>{2, 1, 1, 3}, std::vector<double>{4, 7}, x));
  CHECK_CLOSE(x[0], 1, 1e-14, 0);
  CHECK_CLOSE(x[1], 2, 1e-14, 0);
  CHECK_FALSE(
      solve_positive_definite(std::vector<double>{1, 2, 2, 1}, std::vector<double>{1, 1}, x));
}

TEST_CASE("the trace of an inverse") {
  CHECK_CLOSE(trace_of_inverse(std::vector<double>{2, 1, 1, 3}, 2).value(), 1.0, 1e-14,
              0);  // (3 + 2) / 5
  CHECK_FALSE(trace_of_inverse(std::vector<double>{1, 2, 2, 1}, 2));
}
