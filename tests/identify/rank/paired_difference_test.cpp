#include "dashpot/identify/rank/paired_difference.h"

#include <cmath>

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;

namespace {

/// What a unit adds to the errors of two models.
struct Pair {
  double model, leader;
};

/// Student's t with three degrees of freedom: a tail so heavy that the fourth moment is infinite.
double heavy(Random& random) {
  double squares = 0;
  for (int k = 0; k < 3; ++k) squares += std::pow(random.normal(), 2);
  return random.normal() / std::sqrt(squares / 3);
}

/// The share of intervals that hold the true difference of the sum over so many units, in %.
template <class Draw>
double coverage(std::size_t units, double truth_per_unit, const Draw& draw) {
  constexpr int kTrials = 4000;
  Random random(units);
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> model, leader;
    for (std::size_t k = 0; k < units; ++k) {
      const Pair pair = draw(random);
      model.push_back(pair.model);
      leader.push_back(pair.leader);
    }
    const auto difference = paired_difference(model, leader);
    const double truth = truth_per_unit * static_cast<double>(units);
    held += difference->low <= truth && truth <= difference->high;
  }
  return 100.0 * held / kTrials;
}

/// Errors of two models on units of unlike difficulty, all spread log-normally.
struct UnlikeUnits {
  double worse;  ///< how many times the model's error is the leader's, on average
  double mean_difference() const { return (worse - 1) * std::exp(0.5 * (0.7 * 0.7 + 0.5 * 0.5)); }
  Pair operator()(Random& random) const {
    const double difficulty = std::exp(0.7 * random.normal());
    const double model = std::exp(0.5 * random.normal()), leader = std::exp(0.5 * random.normal());
    return {worse * difficulty * model, difficulty * leader};
  }
};

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

TEST_CASE("paired difference: the 90 % interval covers 85 to 95 % with heavy tails") {
  for (const std::size_t units : {4, 5, 10, 20}) {
    CAPTURE(units);
    for (const UnlikeUnits& truth : {UnlikeUnits{1}, UnlikeUnits{1.3}}) {
      CAPTURE(truth.worse);
      const double covered = coverage(units, truth.mean_difference(), truth);
      CHECK(covered > 85);
      CHECK(covered < 95);
    }
    const UnlikeUnits twice{2};
    CHECK(coverage(units, twice.mean_difference(), twice) > 80);
    const double covered =
        coverage(units, 0.5, [](Random& random) { return Pair{0.5 + heavy(random), 0}; });
    CHECK(covered > 85);
    CHECK(covered < 95);
  }
}

TEST_CASE("paired difference: models that are equally good are rarely told apart") {
  const UnlikeUnits equal{1};
  for (const std::size_t units : {4, 5, 10, 20}) {
    CAPTURE(units);
    CHECK(100 - coverage(units, 0, equal) < 11);  // two-sided, 10 % claimed
  }
}

TEST_CASE("paired difference: a clear one over five units, worked out by hand") {
  const std::vector<double> model{1, 2, 3, 4, 5}, leader{0, 0, 0, 0, 0};
  const auto difference = paired_difference(model, leader);
  REQUIRE(difference);
  CHECK(difference->esr == 15);
  // s = sqrt(2.5), t(0.95, 4) = 2.13185 (tables): 15 -+ 2.13185 sqrt(5 * 2.5).
  CHECK_CLOSE(difference->low, 15 - 2.13185 * std::sqrt(12.5), 1e-5, 0);
  CHECK_CLOSE(difference->high, 15 + 2.13185 * std::sqrt(12.5), 1e-5, 0);
  CHECK(!difference->holds_zero());

  // The same differences in turn for and against: they cannot be told apart.
  CHECK(paired_difference(std::vector<double>{1, 0, 3, 0, 5}, std::vector<double>{0, 2, 0, 4, 0})
            ->holds_zero());
  CHECK(paired_difference(leader, leader)->holds_zero());
  CHECK(!paired_difference(std::vector<double>{1}, std::vector<double>{0}));
}

TEST_CASE("what units add to the error: folds, else records, else stretches of few records") {
  Evaluation first, second;
  first.records = {result_with(1, 100), result_with(4, 100)};
  second.records = {result_with(9, 200)};

  // Over all 400 samples of +-10 N, ESR = 100 (100 * 1 + 100 * 4 + 200 * 9) / 40000 = 5.75.
  const std::vector<double> by_fold = esr_parts(std::vector{first, second});
  REQUIRE(by_fold.size() == 2);
  CHECK_CLOSE(by_fold[0], 1.25, 1e-12, 0);
  CHECK_CLOSE(by_fold[1], 4.5, 1e-12, 0);
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
