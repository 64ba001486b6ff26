#include "dashpot/identify/many/population.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dashpot/numerics/distributions.h"

namespace dashpot {
namespace {

constexpr std::size_t kLeastDampers = 10;
constexpr double kNormalFromMedianDeviation = 1.4826;  // of a normal distribution
constexpr double kTail = 0.1, kNormalTail = 1.2815515655446004;
constexpr double kEfficiency = 0.37;    // of the median absolute deviation, normal distribution
constexpr double kHardlyVaries = 1e-9;  // of the median: rounding
constexpr double kSeenDrift = 1e-3;
constexpr std::size_t kBlocks = 60, kLeastBlocks = 8, kLeastInBlock = 5;

/// The value below which that share of the numbers lies, between the two nearest ones; the numbers
/// are put into another order.
double share_point(std::vector<double>& numbers, double share) {
  const double place = share * static_cast<double>(numbers.size() - 1);
  const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(place);
  std::ranges::nth_element(numbers, at);
  const double low = *at;
  if (at + 1 == numbers.end()) return low;
  const double high = *std::min_element(at + 1, numbers.end());
  return low + (place - std::floor(place)) * (high - low);
}

double median_of(std::vector<double> numbers) { return share_point(numbers, 0.5); }

/// The numbers of one quantity with the serial numbers of their dampers, by serial number.
struct Series {
  std::vector<double> serials, values;
};

Series series_of(const std::vector<double>& column, std::span<const double> serials,
                 const std::vector<std::size_t>& order) {
  Series series;
  for (const std::size_t k : order)
    if (std::isfinite(column[k])) {
      series.serials.push_back(serials[k]);
      series.values.push_back(column[k]);
    }
  return series;
}

Drift drift_of(const Series& series) {
  Drift drift;
  const std::size_t count = series.values.size();
  const std::size_t blocks = std::min(kBlocks, count / kLeastInBlock);
  if (blocks < kLeastBlocks) return drift;

  // The medians of blocks of equally many dampers.
  std::vector<double> place, middle;
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto first = static_cast<std::ptrdiff_t>(b * count / blocks),
               last = static_cast<std::ptrdiff_t>((b + 1) * count / blocks);
    place.push_back(median_of({series.serials.begin() + first, series.serials.begin() + last}));
    middle.push_back(median_of({series.values.begin() + first, series.values.begin() + last}));
  }

  // The median slope of all pairs (Theil and Sen), and how many pairs rise rather than fall.
  std::vector<double> slopes;
  double rises = 0;
  for (std::size_t a = 0; a < blocks; ++a)
    for (std::size_t b = a + 1; b < blocks; ++b) {
      if (place[b] > place[a]) slopes.push_back((middle[b] - middle[a]) / (place[b] - place[a]));
      rises += middle[b] > middle[a] ? 1 : middle[b] < middle[a] ? -1 : 0;
    }
  if (slopes.empty()) return drift;
  const auto n = static_cast<double>(blocks);
  const double deviation = std::sqrt(n * (n - 1) * (2 * n + 5) / 18);
  const double steps = std::max(0.0, std::abs(rises) - 1) / deviation;
  drift.is_tested = true;
  drift.slope = median_of(slopes);
  drift.probability = std::erfc(steps / std::numbers::sqrt2);
  return drift;
}

Usual usual_of(const Series& series) {
  Usual usual{.count = series.values.size()};
  if (usual.count == 0) return usual;

  // The median, taken where the drift, if there is one, passes the middle of the serial numbers.
  usual.drift = drift_of(series);
  usual.centre = median_of(series.serials);
  std::vector<double> rest = series.values;
  if (usual.drift.is_seen())
    for (std::size_t k = 0; k < rest.size(); ++k)
      rest[k] -= usual.drift.slope * (series.serials[k] - usual.centre);
  usual.median = median_of(rest);

  // How far the dampers scatter on either side.
  std::vector<double> distances;
  for (double& value : rest) distances.push_back(std::abs(value -= usual.median));
  const double spread = kNormalFromMedianDeviation * median_of(distances);
  if (!(spread > kHardlyVaries * std::abs(usual.median))) return usual;
  usual.below = std::max(spread, -share_point(rest, kTail) / kNormalTail);
  usual.above = std::max(spread, share_point(rest, 1 - kTail) / kNormalTail);
  return usual;
}

}  // namespace

bool Drift::is_seen() const { return is_tested && probability < kSeenDrift; }

PopulationReport judge_population(const std::vector<std::vector<double>>& columns,
                                  std::span<const double> serials, double false_alarms) {
  std::vector<std::size_t> order(serials.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return serials[k]; });

  // What is usual, and which quantities can be judged by it.
  PopulationReport report;
  const auto is_judged = [](const Usual& usual) {
    return usual.count >= kLeastDampers && usual.below > 0;
  };
  for (const std::vector<double>& column : columns) {
    report.usual.push_back(usual_of(series_of(column, serials, order)));
    report.judged_columns += is_judged(report.usual.back());
  }

  // Each quantity has an equal part of the false alarms, on two sides.
  report.limits.assign(columns.size(), std::numeric_limits<double>::infinity());
  for (std::size_t q = 0; q < columns.size(); ++q) {
    if (!is_judged(report.usual[q])) continue;
    const double degrees =
        std::max(2.0, kEfficiency * static_cast<double>(report.usual[q].count - 1));
    const double tail = false_alarms / static_cast<double>(2 * report.judged_columns);
    report.limits[q] = students_t_quantile(degrees, 1 - tail);
  }

  // Every damper in every judged quantity.
  for (std::size_t k = 0; k < serials.size(); ++k) {
    bool judged = false;
    const std::size_t before = report.outliers.size();
    for (std::size_t q = 0; q < columns.size(); ++q) {
      const Usual& usual = report.usual[q];
      const double value = columns[q][k];
      if (!is_judged(usual) || !std::isfinite(value)) continue;
      judged = true;
      const double expected = usual.expected(serials[k]), off = value - expected;
      const double score = off / (off < 0 ? usual.below : usual.above);
      if (std::abs(score) > report.limits[q])
        report.outliers.push_back({k, q, value, expected, score});
    }
    std::ranges::stable_sort(report.outliers.begin() + static_cast<std::ptrdiff_t>(before),
                             report.outliers.end(), std::greater<>(),
                             [](const Outlier& found) { return std::abs(found.score); });
    report.judged += judged;
  }
  return report;
}

}  // namespace dashpot
