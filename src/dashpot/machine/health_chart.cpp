#include "dashpot/machine/health_chart.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

double normal_at_most(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// The same of a normal number that is held within kMostScore.
double held_at_most(double x) {
  return x >= kMostScore ? 1 : x < -kMostScore ? 0 : normal_at_most(x);
}

/// What the days so far say of the next one: least squares of value over 1 and what is known, and
/// what they leave.
class DaysBefore {
 public:
  explicit DaysBefore(std::size_t known)
      : size_(1 + known), normal_(size_ * size_), right_(size_) {}

  std::size_t count() const { return count_; }

  struct Expected {
    double value = 0;
    double scatter = 0;  ///< of a day about its expectation, that of the latter included
    double degrees = 0;  ///< of freedom; 0: too few days
  };
  Expected of(const ChartDay& day) const {
    // What has been the same on all days explains nothing, and of another value nothing is known.
    const std::vector<double> row = row_of(day);
    std::vector<double> normal = normal_;
    std::size_t explaining = size_;
    for (std::size_t k = 0; k < size_; ++k) {
      if (normal[k * size_ + k] > 0) continue;
      if (row[k] != 0) return {};
      normal[k * size_ + k] = 1;
      --explaining;
    }
    if (count_ <= explaining) return {};

    std::vector<double> by(size_), reach(size_);
    if (!solve_positive_definite(normal, right_, by) ||
        !solve_positive_definite(normal, row, reach))
      return {};
    Expected expected{.degrees = static_cast<double>(count_ - explaining)};
    double leverage = 1, left = squares_;
    for (std::size_t k = 0; k < size_; ++k) {
      expected.value += by[k] * row[k];
      leverage += reach[k] * row[k];
      left -= by[k] * right_[k];
    }
    expected.value += origin_;
    expected.scatter = std::sqrt(std::max(left, 0.0) / expected.degrees * leverage);
    return expected;
  }
  void learn(const ChartDay& day) {
    // The first day is the origin, so that squares do not cancel.
    if (count_ == 0) {
      origin_ = day.value;
      known_origin_ = day.known;
    }
    const std::vector<double> row = row_of(day);
    const double value = day.value - origin_;
    for (std::size_t i = 0; i < size_; ++i) {
      right_[i] += row[i] * value;
      for (std::size_t k = 0; k < size_; ++k) normal_[i * size_ + k] += row[i] * row[k];
    }
    squares_ += value * value;
    ++count_;
  }

 private:
  std::vector<double> row_of(const ChartDay& day) const {
    std::vector<double> row = {1};
    for (std::size_t k = 0; k < day.known.size(); ++k)
      row.push_back(day.known[k] - (known_origin_.empty() ? 0 : known_origin_[k]));
    return row;
  }

  std::size_t size_, count_ = 0;
  std::vector<double> normal_, right_, known_origin_;
  double squares_ = 0, origin_ = 0;
};

/// The fall of a chart whose alarm stands, from the day on at which it is most likely to have
/// begun.
void add_fall(std::span<const ChartDay> days, Chart& chart) {
  // Back from the alarm: the days whose mean score is the least likely to be chance.
  chart.since = *chart.alarm;
  double scores = 0, judged = 0, most = 0;
  for (std::size_t d = *chart.alarm + 1; d-- > 0 && chart.points[d].sum > 0;) {
    if (!chart.points[d].is_judged) continue;
    scores -= chart.points[d].score;
    judged += 1;
    if (scores / std::sqrt(judged) <= most) continue;
    most = scores / std::sqrt(judged);
    chart.since = d;
  }

  // Their mean fall, and how well it is known.
  double variance = 0, count = 0;
  for (std::size_t d = chart.since; d <= *chart.alarm; ++d) {
    if (!days[d].counts) continue;
    chart.fall += chart.points[d].expected - days[d].value;
    variance += std::pow(chart.points[d].scatter, 2);
    count += 1;
  }
  chart.fall /= count;
  chart.fall_deviation = std::sqrt(variance) / count;
}

}  // namespace

double cusum_run_length(double allowance, double threshold) {
  // The sum on a grid, each point for those within half a step: where it goes from each of them.
  constexpr std::size_t kPoints = 120;
  const double step = 2 * threshold / (2 * kPoints - 1);
  std::vector<double> stays(kPoints * kPoints), ones(kPoints, 1.0);
  for (std::size_t i = 0; i < kPoints; ++i)
    for (std::size_t k = 0; k < kPoints; ++k) {
      const double rise = step * (static_cast<double>(k) - static_cast<double>(i)) + allowance;
      const double below = k == 0 ? 0 : held_at_most(rise - 0.5 * step);
      stays[i * kPoints + k] = (i == k ? 1 : 0) - (held_at_most(rise + 0.5 * step) - below);
    }
  return solve(stays, ones).front();
}

double cusum_threshold(double allowance, double days) {
  double low = 0.01, high = 40;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (cusum_run_length(allowance, middle) < days ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::size_t fewest_reference_days(std::size_t known) { return known + 4; }

Chart health_chart(std::span<const ChartDay> days, const ChartOptions& options) {
  const std::size_t known = days.empty() ? 0 : days.front().known.size();
  assert(options.reference >= fewest_reference_days(known));
  Chart chart{.threshold = options.threshold > 0
                               ? options.threshold
                               : cusum_threshold(0.5 * options.shift, options.days)};
  DaysBefore before(known);
  double sum = 0;
  for (std::size_t d = 0; d < days.size(); ++d) {
    // What the sound days before lead to expect of this one.
    const DaysBefore::Expected expected = before.of(days[d]);
    ChartPoint point{.expected = expected.value, .scatter = expected.scatter};
    if (days[d].counts && before.count() >= options.reference && expected.scatter > 0) {
      // By how much it lies below, summed up: an alarm where that is more than chance.
      point.is_judged = true;
      const double t = (days[d].value - expected.value) / expected.scatter;
      point.score = normal_score(expected.degrees, t);
      sum = std::max(0.0,
                     sum - std::clamp(point.score, -kMostScore, kMostScore) - 0.5 * options.shift);
      if (sum > chart.threshold && !chart.alarm) chart.alarm = d;
    }
    point.sum = sum;
    chart.points.push_back(point);

    // Days are sound until then.
    if (days[d].counts && !chart.alarm) before.learn(days[d]);
  }
  if (chart.alarm) add_fall(days, chart);
  return chart;
}

}  // namespace dashpot
