#include "dashpot/identify/judge/residual_test.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/numerics/distributions.h"

namespace dashpot {
namespace {

constexpr std::size_t kLeastSamples = 200, kResidualLags = 20, kBlocks = 10;
constexpr std::size_t kDelays = 6;        // from 0 to kLongestDelay, evenly
constexpr std::size_t kDelayShare = 100;  // the longest delay is this part of the record ...
constexpr std::size_t kMostDelay = 200;   // ... and at most so many samples

std::vector<double> without_mean(std::span<const double> samples) {
  std::vector<double> result(samples.begin(), samples.end());
  const double mean =
      std::accumulate(result.begin(), result.end(), 0.0) / static_cast<double>(result.size());
  for (double& sample : result) sample -= mean;
  return result;
}

double product_at(std::span<const double> a, std::span<const double> b, std::size_t lag) {
  double sum = 0;
  for (std::size_t k = lag; k < a.size(); ++k) sum += a[k] * b[k - lag];
  return sum;
}

/// Ljung and Box 1978: Q = n (n + 2) sum r_k^2 / (n - k) is chi squared where all r_k are 0.
void test_memory(std::span<const double> residual, double step, ResidualTest& test) {
  const auto n = static_cast<double>(residual.size());
  const double power = product_at(residual, residual, 0);
  for (std::size_t lag = 1; lag <= kResidualLags; ++lag) {
    const double r = product_at(residual, residual, lag) / power;
    test.portmanteau += n * (n + 2) * r * r / (n - static_cast<double>(lag));
  }
  test.lags = kResidualLags;
  test.limit = chi_squared_quantile(static_cast<double>(kResidualLags), kResidualConfidence);

  // How long it remembers.
  std::size_t lag = 1;
  while (lag < residual.size() / 4 && product_at(residual, residual, lag) > 0.5 * power) ++lag;
  test.memory = static_cast<double>(lag) * step;
}

InputCorrelation correlation_with(const std::string& name, std::span<const double> residual,
                                  std::span<const double> input, double step) {
  InputCorrelation result{.input = name};
  const double scale = std::sqrt(product_at(residual, residual, 0) * product_at(input, input, 0));
  const std::size_t longest = std::min(kMostDelay, residual.size() / kDelayShare);
  result.limit = students_t_quantile(kBlocks - 1, 1 - (1 - kResidualConfidence) / (2 * kDelays));
  for (std::size_t k = 0; k < kDelays; ++k) {
    const std::size_t delay = k * longest / (kDelays - 1);
    const double r = product_at(residual, input, delay) / scale;
    if (std::abs(r) > std::abs(result.largest)) {
      result.largest = r;
      result.delay = static_cast<double>(delay) * step;
    }

    // Means over equal blocks, and the t of their mean.
    std::vector<double> means(kBlocks);
    const std::size_t length = (residual.size() - delay) / kBlocks;
    for (std::size_t b = 0; b < kBlocks; ++b)
      means[b] = std::inner_product(
                     residual.begin() + static_cast<std::ptrdiff_t>(delay + b * length),
                     residual.begin() + static_cast<std::ptrdiff_t>(delay + (b + 1) * length),
                     input.begin() + static_cast<std::ptrdiff_t>(b * length), 0.0) /
                 static_cast<double>(length);
    const double mean = std::accumulate(means.begin(), means.end(), 0.0) / kBlocks;
    double squares = 0;
    for (const double m : means) squares += (m - mean) * (m - mean);
    const double error = std::sqrt(squares / (kBlocks - 1) / kBlocks);
    const double t = error > 0 ? mean / error : 0;
    if (std::abs(t) > std::abs(result.statistic)) result.statistic = t;
  }
  return result;
}

bool is_moving(std::span<const double> samples) {
  return std::ranges::any_of(samples, [&](double x) { return x != samples.front(); });
}

}  // namespace

bool InputCorrelation::is_independent() const { return std::abs(statistic) <= limit; }
bool ResidualTest::is_tested() const { return lags > 0; }
bool ResidualTest::is_white() const { return is_tested() && portmanteau <= limit; }

ResidualTest test_residual(const RecordResult& result) {
  ResidualTest test{.record = result.record};
  if (result.diverged_at || result.measured.size() < result.warm_up + kLeastSamples) return test;
  std::vector<double> residual;
  for (std::size_t k = result.warm_up; k < result.measured.size(); ++k)
    residual.push_back(result.measured[k] - result.modelled[k]);
  test.samples = residual.size();
  if (!is_moving(residual)) return test;
  residual = without_mean(residual);
  const double step =
      (result.time.back() - result.time[result.warm_up]) / static_cast<double>(residual.size() - 1);
  test_memory(residual, step, test);

  // The inputs that vary, from the end of the warm-up on.
  for (const auto& [name, samples] :
       {std::pair<std::string, const std::vector<double>*>{"displacement", &result.displacement},
        {"velocity", &result.velocity},
        {"drive", &result.drive}}) {
    if (samples->size() != result.measured.size()) continue;
    const std::span<const double> scored = std::span(*samples).subspan(result.warm_up);
    if (is_moving(scored))
      test.inputs.push_back(correlation_with(name, residual, without_mean(scored), step));
  }
  return test;
}

std::string residual_verdict(const std::vector<ResidualTest>& tests) {
  std::size_t tested = 0, white = 0;
  std::vector<std::pair<std::string, std::pair<std::size_t, std::size_t>>> inputs;
  for (const ResidualTest& test : tests) {
    tested += test.is_tested() ? 1 : 0;
    white += test.is_white() ? 1 : 0;
    for (const InputCorrelation& with : test.inputs) {
      auto found = std::ranges::find(inputs, with.input, [](const auto& i) { return i.first; });
      if (found == inputs.end()) found = inputs.insert(inputs.end(), {with.input, {0, 0}});
      ++found->second.first;
      found->second.second += with.is_independent() ? 1 : 0;
    }
  }
  if (tested == 0) return {};

  // What is left where all is well is noise: white, and of no input.
  std::string text = fmt::format("Residuals at {:.0f} % confidence: white in {} of {}",
                                 100 * kResidualConfidence, white, counted(tested, "record"));
  bool all = white == tested;
  for (const auto& [name, counts] : inputs) {
    text += fmt::format("; independent of {} in {} of {}", name, counts.second, counts.first);
    all = all && counts.first == counts.second;
  }
  return text + (all ? ". Nothing is left that this record length can show."
                     : ". The model leaves something over that it could explain.");
}

}  // namespace dashpot
