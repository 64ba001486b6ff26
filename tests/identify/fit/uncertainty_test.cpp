#include "dashpot/identify/fit/uncertainty.h"

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;
using Matrices = std::vector<std::vector<double>>;

TEST_CASE("white residuals count one by one, correlated ones do not") {
  constexpr std::size_t kCount = 40000;
  Random random(5);
  std::vector<double> white(kCount), smooth(kCount);
  constexpr double kCorrelation = 0.9;  // AR(1): 1 + 2 sum rho^k = (1 + rho) / (1 - rho) = 19
  double last = 0;
  for (std::size_t k = 0; k < kCount; ++k) {
    white[k] = random.normal();
    last = kCorrelation * last + random.normal();
    smooth[k] = last;
  }
  // tolerances: about three standard errors of an autocorrelation sum over this many samples
  CHECK_CLOSE(correlation_length(white, {{0, kCount}}), 1, 0, 0.05);
  CHECK_CLOSE(correlation_length(smooth, {{0, kCount}}), 19, 0.25, 0);
}

TEST_CASE("segments are not correlated across their ends") {
  // Two constant pieces of opposite sign: within a piece, lags 1 and 2 correlate fully.
  const std::vector<double> r = {1, 1, 1, -1, -1, -1};
  // 1 + 2 (4/6 + 2/6) = 3
  CHECK_CLOSE(correlation_length(r, {{0, 3}, {3, 3}}), 3, 1e-14, 0);
}

TEST_CASE("covariance of a plain least-squares problem") {
  // J'J = [[4, 2], [2, 3]], variance 2: 2 inverse = [[0.75, -0.5], [-0.5, 1]]
  const Covariance c = covariance(Matrices{{4, 2, 2, 3}}, std::vector{2.0}, 2);
  CHECK_CLOSE(c.matrix[0], 0.75, 1e-12, 0);
  CHECK_CLOSE(c.matrix[1], -0.5, 1e-12, 0);
  CHECK_CLOSE(c.matrix[3], 1, 1e-12, 0);
  CHECK(c.confounded.empty());
  CHECK_CLOSE(c.variance(0, std::vector<double>{1, 1}), 0.75 - 1 + 1, 1e-12, 0);
}

TEST_CASE("parts with noise of their own: a line through three points of which one is noisy") {
  // y = a + b x at x = -1, 0, 1 with variances 1, 1, 9: from the estimators mean(y) and (y3 - y1) /
  // 2, var a = 11/9, var b = 10/4, cov = (9 - 1) / 6
  const Covariance c = covariance(Matrices{{1, -1, -1, 1}, {1, 0, 0, 0}, {1, 1, 1, 1}},
                                  std::vector<double>{1, 1, 9}, 2);
  CHECK_CLOSE(c.matrix[0], 11.0 / 9, 1e-12, 0);
  CHECK_CLOSE(c.matrix[1], 8.0 / 6, 1e-12, 0);
  CHECK_CLOSE(c.matrix[3], 2.5, 1e-12, 0);
}

TEST_CASE("each segment has the variance of its own residuals") {
  // mean squares 1 and 16, no neighbour correlation beyond the first zero; one degree of freedom of
  // eight used
  const std::vector<double> r = {1, -1, 1, -1, 4, -4, 4, -4};
  const std::vector<double> v = independent_variances(r, {{0, 4}, {4, 4}}, 1);
  CHECK_CLOSE(v[0], 8.0 / 7, 1e-14, 0);
  CHECK_CLOSE(v[1], 16 * 8.0 / 7, 1e-14, 0);
}

TEST_CASE("what the data cannot tell apart is named") {
  // unknowns 0 and 2 only as a sum; unknown 1 without effect
  const Covariance c = covariance(Matrices{{1, 0, 1, 0, 0, 0, 1, 0, 1}}, std::vector{1.0}, 3);
  CHECK(c.without_effect == std::vector<std::size_t>{1});
  REQUIRE(c.confounded.size() == 1);
  CHECK(c.confounded[0] == std::vector<std::size_t>{0, 2});
}

TEST_CASE("unknowns that change nothing are without effect, all of them too") {
  const std::vector<std::vector<double>> parts = {std::vector<double>(4)};
  const Covariance none = covariance(parts, std::vector<double>{1}, 2);
  CHECK(none.without_effect == std::vector<std::size_t>{0, 1});
  CHECK(none.confounded.empty());
}
