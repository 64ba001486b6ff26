#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace dashpot {

/// What one block of the data tells of n unknowns about some values of theirs: the information J'J
/// (n x n, row by row) and the score J'r.
struct BlockOfData {
  std::vector<double> information, score;
};

/// How certain an estimate is, by how far it would go without one block after the other, to first
/// order (the jackknife). The blocks' scores are taken to be independent, and nothing else is asked
/// of what is left: within a block it may be correlated, and its size may change. A block that
/// tells most of an unknown counts for as much: its own score is small, since the estimate follows
/// it.
class Jackknife {
 public:
  Jackknife(std::span<const BlockOfData> blocks, std::size_t n);

  /// From the values at which the blocks were looked at to where their scores add up to 0.
  const std::vector<double>& step() const { return step_; }
  /// Of the unknowns there, n x n; 0 for one without effect.
  const std::vector<double>& covariance() const { return covariance_; }
  /// Half the interval, 1 - 2 `beyond` of all, of sum weights[k] x[first + k]: by Student's t.
  double half(std::size_t first, std::span<const double> weights, double beyond = 0.025) const;
  /// Likewise of what unknown k is here more than in another estimate of it from the same blocks,
  /// by the fewer degrees of freedom of the two.
  double half_of_difference(const Jackknife& other, std::size_t k, double beyond = 0.025) const;
  /// Degrees of freedom of that sum's variance, at least 1: those of the chi squared with its mean
  /// and variance where what is left is white (Satterthwaite; for blocks: Bell and McCaffrey,
  /// Survey Methodology 28 (2002) 169-181).
  double degrees(std::size_t first, std::span<const double> weights) const;

 private:
  std::size_t n_;
  std::vector<std::vector<double>> information_;  ///< per block, in scales of each unknown
  std::vector<std::vector<double>> without_;      ///< per block: inverse information of all others
  /// Per block: how far the estimate goes without it, such that their squares add up to variances.
  std::vector<std::vector<double>> ways_;
  std::vector<double> all_, scale_, step_, covariance_;  ///< all_: the inverse of all information
};

}  // namespace dashpot
