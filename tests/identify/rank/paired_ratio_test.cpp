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

/// What a unit adds to the errors of two models.
struct Pair {
  double model, leader;
};

/// Errors that scale: a unit is as much harder for both, whose logarithms are spread besides.
Pair scaled(Random& random, double times, double (*spread)(Random&)) {
  const double difficulty = std::exp(0.7 * random.normal());
  const double model = std::exp(spread(random)), leader = std::exp(spread(random));
  return {times * difficulty * model, difficulty * leader};
}
double normal_spread(Random& random) { return 0.5 * random.normal(); }
double heavy_spread(Random& random) { return 0.3 * heavy(random); }
Pair level(Random& random) { return scaled(random, 1, normal_spread); }
Pair level_with_tails(Random& random) { return scaled(random, 1, heavy_spread); }
Pair five_times(Random& random) { return scaled(random, 5, normal_spread); }

/// Errors that add up: noise that both leave on each unit, what each lacks, and what the model
/// lacks besides, on some units hardly anything. The ratio's logarithm is above 0 and lopsided.
Pair added(Random& random) {
  const auto squares = [&] { return std::pow(random.normal(), 2) + std::pow(random.normal(), 2); };
  const double noise = std::exp(0.5 * random.normal());
  const double leader = noise + 0.5 * squares(), model = noise + 0.5 * squares() + squares();
  return {model, leader};
}

/// What the interval is of: the geometric mean of the ratios of very many units.
template <class Draw>
double typical_ratio(const Draw& draw) {
  constexpr int kMany = 400'000;
  Random random(77);
  double sum = 0;
  for (int k = 0; k < kMany; ++k) {
    const Pair pair = draw(random);
    sum += std::log(pair.model / pair.leader);
  }
  return std::exp(sum / kMany);
}

/// The shares of intervals that hold the true ratio and that lie above 1, %; with `fit_spread`, of
/// the ratio's logarithm, which each half of the units has in common.
struct Shares {
  double held = 0, worse = 0;
};
template <class Draw>
Shares shares(std::size_t units, double truth, const Draw& draw, double fit_spread = 0) {
  constexpr int kTrials = 4000;
  Random random(units);
  Shares shares;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::array<double, 2> fits{fit_spread * random.normal(), fit_spread * random.normal()};
    std::vector<double> model, leader;
    for (std::size_t k = 0; k < units; ++k) {
      const Pair pair = draw(random);
      model.push_back(pair.model * std::exp(fits[2 * k / units]));
      leader.push_back(pair.leader);
    }
    const auto ratio = paired_ratio(model, leader);
    shares.held += 100.0 / kTrials * (ratio->low <= truth && truth <= ratio->high);
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

TEST_CASE(
    "paired ratio: the 90 % interval covers 88 to 94 % where errors scale, with heavy tails") {
  for (const std::size_t units : {4, 5, 10, 20}) {
    CAPTURE(units);
    const double held = shares(units, 1, level).held;
    CHECK(held > 88);
    CHECK(held < 92);
    const double held_with_tails = shares(units, 1, level_with_tails).held;
    CHECK(held_with_tails > 88);
    CHECK(held_with_tails < 94);
  }
}

TEST_CASE("paired ratio: where errors add up the interval covers 88 to 92 %") {
  const double truth = typical_ratio(added);
  CHECK(truth > 1.5);
  for (const std::size_t units : {4, 5, 10, 20}) {
    CAPTURE(units);
    const double held = shares(units, truth, added).held;
    CHECK(held > 88);
    CHECK(held < 92);
  }
}

TEST_CASE("paired ratio: equal models are rarely told apart, one five times as bad nearly always") {
  for (const std::size_t units : {4, 5, 10, 20}) {
    CAPTURE(units);
    CHECK(shares(units, 1, level).worse < 6);  // one side of 10 %
    CHECK(shares(units, 5, five_times).worse > 94);
  }
}

TEST_CASE("paired ratio: records that share the fits of two divisions make the interval short") {
  for (const std::size_t units : {10, 20}) {
    CAPTURE(units);
    const Shares equal = shares(units, 1, level, 0.2);
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
