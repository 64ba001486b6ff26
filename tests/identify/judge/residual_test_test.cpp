#include "dashpot/identify/judge/residual_test.h"

#include <numbers>
#include <random>

#include "dashpot/numerics/distributions.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A record of 5000 samples at 500 Hz whose motion is a random walk, pulled back, and whose
/// residual is what `residual` gives from the noise, the sample's place and the velocity there.
template <typename Residual>
RecordResult result_with(unsigned seed, Residual residual) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  RecordResult result;
  result.record = "run";
  double v = 0, x = 0;
  for (int k = 0; k < 5000; ++k) {
    v += 0.01 * normal(generator) - 0.05 * v;
    x += v / 500 - 0.01 * x;
    result.time.push_back(k / 500.0);
    result.displacement.push_back(x);
    result.velocity.push_back(v);
    result.drive.push_back(1);
    result.modelled.push_back(100 * v);
    result.measured.push_back(100 * v + residual(normal(generator), k, v));
  }
  return result;
}

}  // namespace

TEST_CASE("white noise passes both tests, about as often as the confidence says") {
  int white = 0, independent = 0, inputs = 0;
  constexpr int kRuns = 200;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const ResidualTest test =
        test_residual(result_with(seed, [](double noise, int, double) { return noise; }));
    REQUIRE(test.is_tested());
    white += test.is_white() ? 1 : 0;
    for (const InputCorrelation& with : test.inputs) {
      ++inputs;
      independent += with.is_independent() ? 1 : 0;
    }
  }
  // 99 % of 200 and of 400: at most 7 and 11 rejections with a probability of 0.995 or more.
  CHECK(white >= kRuns - 7);
  CHECK(inputs == 2 * kRuns);  // the drive does not vary
  CHECK(independent >= inputs - 11);
}

TEST_CASE("a residual with memory is not white, but still of no input") {
  int independent = 0, inputs = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    double state = 0;
    const ResidualTest test = test_residual(
        result_with(seed, [&](double noise, int, double) { return state = 0.9 * state + noise; }));
    CHECK(!test.is_white());
    CHECK_CLOSE(test.memory, std::log(0.5) / std::log(0.9) / 500, 0.5, 0);
    for (const InputCorrelation& with : test.inputs) {
      ++inputs;
      independent += with.is_independent() ? 1 : 0;
    }
  }
  CHECK(independent >= inputs - 5);
}

TEST_CASE("what a model leaves of the velocity is found, also late and under noise") {
  const ResidualTest test =
      test_residual(result_with(1, [](double noise, int, double v) { return noise + 10 * v; }));
  const auto velocity = std::ranges::find(test.inputs, "velocity", &InputCorrelation::input);
  REQUIRE(velocity != test.inputs.end());
  CHECK(!velocity->is_independent());
  CHECK(velocity->largest > 0.1);
  CHECK(contains(residual_verdict({test}), "independent of velocity in 0 of 1"));
  CHECK(contains(residual_verdict({test}), "99 % confidence"));
}

TEST_CASE("too short, diverged or perfect: not tested, and said nothing of") {
  RecordResult result = result_with(1, [](double noise, int, double) { return noise; });
  result.warm_up = 4900;
  CHECK(!test_residual(result).is_tested());
  result.warm_up = 0;
  result.diverged_at = 1;
  CHECK(!test_residual(result).is_tested());
  const RecordResult perfect = result_with(1, [](double, int, double) { return 0; });
  CHECK(!test_residual(perfect).is_white());
  CHECK(residual_verdict({test_residual(perfect)}).empty());
}

TEST_CASE("chi squared quantile: from tables") {
  CHECK_CLOSE(chi_squared_quantile(20, 0.99), 37.566, 1e-4, 0);
  CHECK_CLOSE(chi_squared_quantile(1, 0.95), 3.8415, 1e-4, 0);
}
