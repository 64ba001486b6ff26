#pragma once
#include <string>
#include <vector>

#include "dashpot/evaluate.h"

// What a model leaves over: whether the residual (measured less modelled, from the end of the
// warm-up on) has a memory of its own, and whether it still follows the inputs. Both are tests with
// a stated confidence; docs/compare.md has them with their limits.
namespace dashpot {

constexpr double kResidualConfidence = 0.99;

/// Whether the residual goes on with an input, alone or some time after it. The record is cut into
/// ten blocks; the products of residual and delayed input are averaged in each, and a t test asks
/// whether the blocks' means are 0 on average, which needs no white residual: only blocks longer
/// than its memory. The confidence holds for all delays of one input together.
struct InputCorrelation {
  std::string input;     ///< "displacement", "velocity", "drive"
  double largest = 0;    ///< correlation coefficient, of greatest size over the delays
  double delay = 0;      ///< s, at which it is
  double statistic = 0;  ///< t at the delay where it is of greatest size
  double limit = 0;      ///< of |t|
  bool is_independent() const;
};

struct ResidualTest {
  std::string record;
  std::size_t samples = 0;
  std::size_t lags = 0;                  ///< of samples, of the Ljung-Box test
  double portmanteau = 0;                ///< its Q
  double limit = 0;                      ///< of Q, the quantile of chi squared
  double memory = 0;                     ///< s, until the autocorrelation falls below 0.5
  std::vector<InputCorrelation> inputs;  ///< those that vary
  bool is_tested() const;                ///< enough samples, and a residual that varies
  bool is_white() const;                 ///< tested, and Q within its limit
};

/// Of one record's result; untested where it diverged or has fewer than 200 samples.
ResidualTest test_residual(const RecordResult& result);

/// "Residuals: white in 0 of 4 records; ..."; empty where no record was tested.
std::string residual_verdict(const std::vector<ResidualTest>& tests);

}  // namespace dashpot
