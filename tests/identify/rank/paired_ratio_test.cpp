#include "dashpot/identify/rank/paired_ratio.h"

#include <array>
#include <cmath>
#include <numeric>

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Student's t with three degrees of freedom: a tail so heavy that the fourth moment is infinite.
double heavy(Random& random) {
  double squares = 0;
  for (int k = 0; k < 3; ++k) squares += std::pow(random.normal(), 2);
  return random.normal() / std::sqrt(squares / 3);
}

/// Errors of two models on units of unlike difficulty.
struct UnlikeUnits {
  double times;               ///< the typical ratio of the errors
  double (*spread)(Random&);  ///< of the logarithm of either model's error
  double difficulty_spread = 0.7;
  double fit_spread = 0;  ///< of the ratio's logarithm, which each half of the units has in common
};
double normal_spread(Random& random) { return 0.5 * random.normal(); }
double heavy_spread(Random& random) { return 0.3 * heavy(random); }

/// The shares of intervals that hold the true ratio and that lie above 1, %.
struct Shares {
  double held = 0, worse = 0;
};
Shares shares(std::size_t units, const UnlikeUnits& truth) {
  constexpr int kTrials = 4000;
  Random random(units);
  Shares shares;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> model, leader;
    const std::array<double, 2> fits{truth.fit_spread * random.normal(),
                                     truth.fit_spread * random.normal()};
    for (std::size_t k = 0; k < units; ++k) {
      const double difficulty = std::exp(truth.difficulty_spread * random.normal());
      model.push_back(truth.times * difficulty *
                      std::exp(truth.spread(random) + fits[2 * k / units]));
      leader.push_back(difficulty * std::exp(truth.spread(random)));
    }
    const auto ratio = paired_ratio(model, leader);
    shares.held += 100.0 / kTrials * (ratio->low <= truth.times && truth.times <= ratio->high);
    shares.worse += 100.0 / kTrials * ratio->is_worse();
  }
  return shares;
}

RecordResult result_with(double squared, std::size_t samples) {
  RecordResult result;
  for (std::size_t k = 0; k < samples; ++k) {
    result.measured.push_back(k % 2 ? 10 : -10);
    result.modelled.push_back(result.measured.back() + std::sqrt(squared));
    result.sums.add(result.measured.back(), result.modelled.back());
  }
  return result;
}

}  // namespace

TEST_CASE("paired ratio: the 90 % interval covers 88 to 94 %, with heavy tails too") {
  for (const std::size_t units : {4, 5, 10, 20}) {
    CAPTURE(units);
    for (const double times : {1.0, 1.3, 5.0, 20.0}) {
      CAPTURE(times);
      const double held = shares(units, {times, normal_spread}).held;
      CHECK(held > 88);
      CHECK(held < 92);
      const double held_with_tails = shares(units, {times, heavy_spread}).held;
      CHECK(held_with_tails > 88);
      CHECK(held_with_tails < 94);
    }
  }
}

TEST_CASE("paired ratio: equal models are rarely told apart, one five times as bad nearly always") {
  for (const std::size_t units : {4, 5, 10, 20}) {
    CAPTURE(units);
    CHECK(shares(units, {1, normal_spread}).worse < 6);  // one side of 10 %
    CHECK(shares(units, {5, normal_spread}).worse > 94);
    // Units that differ by much more than the models do change nothing.
    CHECK(shares(units, {5, normal_spread, 3}).worse > 94);
  }
}

TEST_CASE("paired ratio: records that share the fits of two divisions make the interval short") {
  for (const std::size_t units : {10, 20}) {
    CAPTURE(units);
    const Shares equal = shares(units, {1, normal_spread, 0.7, 0.2});
    CHECK(equal.held > 75);
    CHECK(equal.worse < 12);  // 5 % are claimed
  }
}

TEST_CASE("paired ratio: a clear one over five units, worked out by hand") {
  // Logarithms of the ratios: 1 to 5, with s = sqrt(2.5); t(0.95, 4) = 2.13185 (tables).
  std::vector<double> model, leader{1, 20, 0.3, 4, 1e-3};
  for (std::size_t k = 0; k < 5; ++k)
    model.push_back(leader[k] * std::exp(static_cast<double>(k + 1)));
  const auto ratio = paired_ratio(model, leader);
  REQUIRE(ratio);
  const double half = 2.13185 * std::sqrt(2.5 / 5);
  CHECK_CLOSE(ratio->times, std::exp(3), 1e-12, 0);
  CHECK_CLOSE(ratio->low, std::exp(3 - half), 1e-5, 0);
  CHECK_CLOSE(ratio->high, std::exp(3 + half), 1e-5, 0);
  CHECK(ratio->is_worse());

  // One that is the better on a typical unit is not called worse, nor is one in turn.
  CHECK(!paired_ratio(leader, model)->is_worse());
  CHECK(
      !paired_ratio(std::vector<double>{1, 2, 1, 2}, std::vector<double>{2, 1, 2, 1})->is_worse());

  // What is left by rounding is no error; a single unit tells nothing.
  const std::vector<double> none(5, 0), rounding{1e-20, 1e-24, 0, 1e-18, 1e-22};
  CHECK(!paired_ratio(rounding, none)->is_worse());
  CHECK(paired_ratio(model, none)->is_worse());
  CHECK(!paired_ratio(std::vector<double>{1}, std::vector<double>{0}));
}

TEST_CASE("what units add to the error: folds, else records, else stretches of few records") {
  Evaluation first, second;
  first.records = {result_with(1, 100), result_with(4, 100)};
  second.records = {result_with(9, 200)};

  // Over all 800 samples of +-10 N, ESR = 200 (100 * 1 + 100 * 4 + 200 * 9) / 80000 = 5.75.
  const std::vector<double> by_fold = esr_parts(std::vector{first, second, second, first});
  REQUIRE(by_fold.size() == 4);
  CHECK_CLOSE(by_fold[0], 1.25 / 2, 1e-12, 0);
  CHECK_CLOSE(by_fold[1], 4.5 / 2, 1e-12, 0);

  // Two folds tell nothing by themselves: three stretches of each record of one, five of the other.
  const std::vector<double> by_both = esr_parts(std::vector{first, second});
  REQUIRE(by_both.size() == 11);
  CHECK_CLOSE(std::accumulate(by_both.begin(), by_both.end(), 0.0), 5.75, 1e-12, 0);
  CHECK_CLOSE(by_both[10], 4.5 / 5, 1e-12, 0);
  const std::vector<double> by_stretch = esr_parts(std::vector{second});
  REQUIRE(by_stretch.size() == 5);
  for (const double part : by_stretch) CHECK_CLOSE(part, 9.0 / 5, 1e-12, 0);
  const std::vector<double> of_two = esr_parts(std::vector{first});
  REQUIRE(of_two.size() == 6);
  CHECK_CLOSE(of_two[3] + of_two[4] + of_two[5], 2, 1e-12, 0);

  first.records.insert(first.records.end(), 3, result_with(4, 100));
  const std::vector<double> by_record = esr_parts(std::vector{first});
  REQUIRE(by_record.size() == 5);
  CHECK_CLOSE(by_record[1], 0.8, 1e-12, 0);

  second.diverged = 1;
  CHECK(esr_parts(std::vector{first, second}).empty());
}
