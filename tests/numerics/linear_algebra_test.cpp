#include "dashpot/numerics/linear_algebra.h"

#include "dashpot/error.h"
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

TEST_CASE("general systems, by hand") {
  // [[0, 2], [1, 3]] has no first pivot: rows must be exchanged. Its inverse is [[-1.5, 1], [0.5,
  // 0]].
  const std::vector<double> matrix{0, 2, 1, 3}, expected{-1.5, 1, 0.5, 0};
  const std::vector<double> inverted = inverse(matrix, 2);
  for (std::size_t k = 0; k < 4; ++k) CHECK_CLOSE(inverted[k], expected[k], 1e-14, 0);

  // Rows and columns are not mixed up: one right side, and two as columns.
  const std::vector<double> x = solve(matrix, std::vector<double>{2, 4});
  CHECK_CLOSE(x[0], 1, 1e-14, 0);
  CHECK_CLOSE(x[1], 1, 1e-14, 0);
  const std::vector<double> columns = solve_columns(matrix, std::vector<double>{2, 0, 4, 1}, 2);
  const std::vector<double> wanted{1, 1, 1, 0};
  for (std::size_t k = 0; k < 4; ++k) CHECK_CLOSE(columns[k], wanted[k], 1e-14, 1e-14);
}

TEST_CASE("a product takes rows times columns, of matrices that are not square") {
  // [[1, 2, 3], [4, 5, 6]] times [[1, 0], [0, 1], [2, -1]], and times (1, 1, 1).
  const std::vector<double> a{1, 2, 3, 4, 5, 6};
  CHECK(product(a, std::vector<double>{1, 0, 0, 1, 2, -1}, 3) ==
        std::vector<double>{7, -1, 16, -1});
  CHECK(product(a, std::vector<double>{1, 1, 1}, 3) == std::vector<double>{6, 15});
}

TEST_CASE("a complex system is solved") {
  // [[i, 1], [2, 0]] x = (2 i, 2): x = (1, i).
  using namespace std::complex_literals;
  const std::vector<std::complex<double>> x = solve(std::vector<std::complex<double>>{1i, 1, 2, 0},
                                                    std::vector<std::complex<double>>{2i, 2});
  CHECK(std::abs(x[0] - 1.0) < 1e-14);
  CHECK(std::abs(x[1] - 1i) < 1e-14);
}

TEST_CASE("factors serve many right sides and the next matrix") {
  // Columns one after the other: [[1, 3], [2, 4]].
  Factors factors;
  std::vector<double> x(2);
  factors.factorise_columns(std::vector<double>{1, 2, 3, 4}, 2);
  factors.solve(std::vector<double>{4, 6}, x);
  CHECK_CLOSE(x[0], 1, 1e-14, 0);
  CHECK_CLOSE(x[1], 1, 1e-14, 0);
  factors.solve(std::vector<double>{1, 2}, x);
  CHECK_CLOSE(x[0], 1, 1e-14, 0);
  CHECK_CLOSE(x[1], 0, 0, 1e-14);
  factors.factorise_columns(std::vector<double>{2, 0, 0, 4}, 2);
  factors.solve(std::vector<double>{1, 2}, x);
  CHECK(x == std::vector<double>{0.5, 0.5});
}

TEST_CASE("factors of small and of large matrices solve what was multiplied out") {
  for (const std::size_t n : {1, 5, 8, 9, 12}) {
    // A Hilbert matrix turned upside down, so that rows must change places, with ones on top.
    std::vector<double> columns(n * n), wanted(n), right(n), x(n);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i)
        columns[j * n + i] = 1 / static_cast<double>(n - i + j) + (i == j ? 1 : 0);
    for (std::size_t j = 0; j < n; ++j) {
      wanted[j] = static_cast<double>(j) - 2;
      for (std::size_t i = 0; i < n; ++i) right[i] += columns[j * n + i] * wanted[j];
    }

    Factors factors;
    factors.factorise_columns(columns, n);
    factors.solve(right, x);
    for (std::size_t k = 0; k < n; ++k) CHECK_CLOSE(x[k], wanted[k], 1e-11, 1e-11);
  }

  // The first number is 0: no pivot without another row.
  Factors factors;
  std::vector<double> x(3);
  factors.factorise_columns(std::vector<double>{0, 2, 0, 0, 0, 4, 8, 0, 0}, 3);
  factors.solve(std::vector<double>{8, 2, 4}, x);
  CHECK(x == std::vector<double>{1, 1, 1});
}

TEST_CASE("the exponential of a rotation and of a shear") {
  // exp([[0, -t], [t, 0]]) turns by t; a shear's series ends after its first power.
  const double t = 2;
  const std::vector<double> turn = exponential(std::vector<double>{0, -t, t, 0}, 2),
                            shear = exponential(std::vector<double>{0, 5, 0, 0}, 2);
  SmallMatrix<7, 7> small;
  small(1, 5) = -t;
  small(5, 1) = t;
  const SmallMatrix<7, 7> turned = exponential(small);
  CHECK_CLOSE(turned(1, 5), -std::sin(t), 1e-13, 0);
  CHECK_CLOSE(turned(5, 5), std::cos(t), 1e-13, 0);
  CHECK(turned(6, 6) == 1);

  CHECK_CLOSE(turn[0], std::cos(t), 1e-13, 0);
  CHECK_CLOSE(turn[1], -std::sin(t), 1e-13, 0);
  CHECK_CLOSE(turn[2], std::sin(t), 1e-13, 0);
  const std::vector<double> expected{1, 5, 0, 1};
  for (std::size_t k = 0; k < 4; ++k) CHECK_CLOSE(shear[k], expected[k], 1e-14, 1e-14);
}

TEST_CASE("eigenvalues of a pair of matrices") {
  // Two masses of 1 and 4 kg, each on a spring of its own: 9 / 1 and 4 / 4, ascending.
  const std::vector<double> found =
      eigenvalues(std::vector<double>{9, 0, 0, 4}, std::vector<double>{1, 0, 0, 4}, 2);
  REQUIRE(found.size() == 2);
  CHECK_CLOSE(found[0], 1, 1e-13, 0);
  CHECK_CLOSE(found[1], 9, 1e-13, 0);
}

TEST_CASE("the regulator of a mass on ice") {
  // x'' = u with the cost x^2 + u^2: the textbook's gain is (1, sqrt 2).
  const RegulatorProblem problem{.states = 2,
                                 .inputs = 1,
                                 .a = {0, 1, 0, 0},
                                 .b = {0, 1},
                                 .q = {1, 0, 0, 0},
                                 .n = {0, 0},
                                 .r = {1}};
  const std::vector<double> gain = regulator_gain(problem);
  REQUIRE(gain.size() == 2);
  CHECK_CLOSE(gain[0], 1, 1e-12, 0);
  CHECK_CLOSE(gain[1], std::sqrt(2.0), 1e-12, 0);

  // What the input does not reach and nothing damps cannot be regulated; an input must cost.
  RegulatorProblem lost = problem, free = problem;
  lost.b = {0, 0};
  free.r = {0};
  CHECK_THROWS_AS(regulator_gain(lost), Error);
  CHECK_THROWS_AS(regulator_gain(free), Error);
}
