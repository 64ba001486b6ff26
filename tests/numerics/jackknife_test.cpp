#include "dashpot/numerics/jackknife.h"

#include <array>

#include "dashpot/base/random.h"
#include "dashpot/numerics/distributions.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("jackknife: of a mean it is what every textbook has") {
  // Five numbers about their mean: s^2 / n with n - 1 degrees of freedom; the second unknown has no
  // effect.
  const std::array<double, 5> left = {3, -1, 2, -4, 0};
  std::vector<BlockOfData> blocks;
  double squares = 0;
  for (const double one : left) {
    blocks.push_back({{1, 0, 0, 0}, {one, 0}});
    squares += one * one;
  }
  const Jackknife jackknife(blocks, 2);
  CHECK_CLOSE(jackknife.covariance()[0], squares / 4 / 5, 1e-12, 0);
  CHECK(jackknife.covariance()[3] == 0);
  CHECK_CLOSE(jackknife.degrees(0, std::array{1.0}), 4, 1e-12, 0);
  CHECK_CLOSE(jackknife.degrees(0, std::array{-7.0}), 4, 1e-12, 0);
}

TEST_CASE("jackknife: its intervals hold where one block tells most and samples are correlated") {
  // A slope through 0 from ten blocks of 30 samples, of which the first is moved three times as
  // much; what is left remembers its last samples and grows with the motion.
  constexpr int kRepetitions = 500, kBlocks = 10, kSamples = 30;
  Random random(11);
  int by_jackknife = 0, by_scores = 0;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    std::vector<BlockOfData> blocks;
    double information = 0, score = 0, x = 0, remembered = 0;
    for (int b = 0; b < kBlocks; ++b) {
      blocks.push_back({{0}, {0}});
      for (int k = 0; k < kSamples; ++k) {
        x = 0.7 * x + random.normal();
        remembered = 0.7 * remembered + random.normal();
        const double moved = (b == 0 ? 3 : 1) * x, left = remembered * (1 + 0.3 * std::abs(moved));
        blocks.back().information[0] += moved * moved;
        blocks.back().score[0] += moved * left;
      }
      information += blocks.back().information[0];
      score += blocks.back().score[0];
    }

    // At the solution, which is off by so much, the scores add up to 0.
    const double off = score / information;
    double squares = 0;
    for (BlockOfData& one : blocks) {
      one.score[0] -= one.information[0] * off;
      squares += one.score[0] * one.score[0];
    }
    const Jackknife jackknife(blocks, 1);
    by_jackknife += std::abs(off) < jackknife.half(0, std::array{1.0});
    by_scores += std::abs(off) < kNormal95 * std::sqrt(squares) / information;
  }
  CHECK(by_jackknife > 0.93 * kRepetitions);
  CHECK(by_jackknife < 0.99 * kRepetitions);
  CHECK(by_scores < 0.85 * kRepetitions);
}

TEST_CASE("jackknife: from scores that do not add up to 0 it steps to where they do") {
  // Samples about their mean, looked at from 10 above: the same as from the mean itself.
  std::vector<BlockOfData> far, near;
  for (const double sample : {2.0, 5.0, 3.0, 6.0}) {
    far.push_back({{1}, {14 - sample}});
    near.push_back({{1}, {4 - sample}});
  }
  const Jackknife from_far(far, 1), from_near(near, 1);
  CHECK_CLOSE(from_far.step()[0], -10, 1e-12, 0);
  CHECK_CLOSE(from_near.step()[0], 0, 0, 1e-12);
  CHECK_CLOSE(from_far.covariance()[0], from_near.covariance()[0], 1e-12, 0);
}

TEST_CASE("jackknife: of a difference of two estimates from the same blocks, pair by pair") {
  // Two means of five pairs about them; of two means that are one the difference is 0.
  const std::array<double, 5> left = {3, -1, 2, -4, 0}, other = {2, -2, 1, -3, 2};
  std::vector<BlockOfData> blocks, others;
  double squares = 0;
  for (std::size_t b = 0; b < left.size(); ++b) {
    blocks.push_back({{1}, {left[b]}});
    others.push_back({{1}, {other[b]}});
    squares += std::pow(left[b] - other[b], 2);
  }
  const Jackknife mean(blocks, 1), of_others(others, 1);
  CHECK_CLOSE(mean.half_of_difference(of_others, 0, 0.01),
              students_t_quantile(4, 0.99) * std::sqrt(squares / 4 / 5), 1e-12, 0);
  CHECK(mean.half_of_difference(mean, 0) == 0);
}
