#include "dashpot/record/time_base.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"

namespace dashpot {
namespace {

/// The power of ten to which the stamps are printed, or 0 when they have all their digits.
double printed_digit(std::span<const double> stamps) {
  const auto looked_at = stamps.first(std::min<std::size_t>(stamps.size(), 5000));
  for (double scale = 1; scale < 1e10; scale *= 10) {
    const auto on_grid = [&](double t) {
      return std::abs(t * scale - std::round(t * scale)) <= 1e-6 + 4e-16 * std::abs(t * scale);
    };
    if (std::all_of(looked_at.begin(), looked_at.end(), on_grid)) return 1 / scale;
  }
  return 0;
}

struct Line {
  double start = 0, step = 0;
};

/// Least-squares line through stamp over index.
Line fit_line(std::span<const double> stamps) {
  const auto n = static_cast<double>(stamps.size());
  const double middle = (n - 1) / 2;
  double mean = 0, product = 0;
  for (const double t : stamps) mean += (t - stamps[0]) / n;
  for (std::size_t k = 0; k < stamps.size(); ++k)
    product += (static_cast<double>(k) - middle) * (stamps[k] - stamps[0] - mean);
  const double step = product / (n * (n * n - 1) / 12);
  return {stamps[0] + mean - step * middle, step};
}

/// A rate that is a whole number of hertz, or a step with the printed digits, when the fit allows it.
double snapped(double step, double tolerance, double digit) {
  const double rate = std::round(1 / step);
  if (rate >= 1 && std::abs(1 / rate - step) <= tolerance) return 1 / rate;
  if (digit > 0) {
    const double scale = std::round(1 / digit), steps = std::round(step * scale);
    if (steps >= 1 && std::abs(steps / scale - step) <= tolerance) return steps / scale;
  }
  return step;
}

std::vector<double> interpolate(const std::vector<double>& from, const std::vector<double>& values,
                                const std::vector<double>& to) {
  std::vector<double> out;
  out.reserve(to.size());
  std::size_t k = 0;
  for (const double t : to) {
    while (k + 2 < from.size() && from[k + 1] < t) ++k;
    const double share = std::clamp((t - from[k]) / (from[k + 1] - from[k]), 0.0, 1.0);
    out.push_back(values[k] + share * (values[k + 1] - values[k]));
  }
  return out;
}

}  // namespace

double uniform_step(std::span<const double> stamps) {
  if (stamps.size() < 2) return 0;
  const Line line = fit_line(stamps);
  const double digit = printed_digit(stamps);
  // Coarse digits (0 1 2 4 5) cannot show that a gap is rounding: then only an exact grid is uniform.
  const double rounding = digit < 0.25 * line.step ? 0.55 * digit : 0;
  const double tolerance = rounding + 1e-6 * line.step;
  for (std::size_t k = 0; k < stamps.size(); ++k)
    if (std::abs(stamps[k] - line.start - line.step * static_cast<double>(k)) > tolerance) return 0;
  return snapped(line.step, 2 * tolerance / static_cast<double>(stamps.size() - 1), digit);
}

void require_increasing(std::span<const double> stamps, const RawTable& table) {
  for (std::size_t k = 1; k < stamps.size(); ++k) {
    if (stamps[k] > stamps[k - 1]) continue;
    const std::string now = format_number(stamps[k], 10), before = format_number(stamps[k - 1], 10);
    throw Error(table.where(k),
                stamps[k] == stamps[k - 1] ? "time " + now + " is repeated"
                                           : "time runs backwards: " + now + " after " + before,
                "time must increase; for a uniform test state its sample_rate in a dataset file");
  }
}

std::vector<double> uniform_time(std::size_t rows, double sample_time) {
  std::vector<double> time(rows);
  // By division where the rate is whole: 3 / 1000.0 is the number that people write as 0.003.
  const double rate = std::round(1 / sample_time);
  const bool whole = rate >= 1 && 1 / rate == sample_time;
  for (std::size_t k = 0; k < rows; ++k)
    time[k] = whole ? static_cast<double>(k) / rate : static_cast<double>(k) * sample_time;
  return time;
}

void resample(Record& record, double rate_hz) {
  const double duration = record.time.back() - record.time.front();
  const double count = std::floor(duration * rate_hz * (1 + 1e-12)) + 1;
  if (count < 2 || count > 1e9)
    throw Error(record.name, "resampling to " + format_number(rate_hz) + " Hz gives " +
                                 format_number(count, 12) + " samples");
  std::vector<double> time = uniform_time(static_cast<std::size_t>(count), 1 / rate_hz);
  for (double& t : time) t += record.time.front();
  for (Channel& channel : record.channels) channel.samples = interpolate(record.time, channel.samples, time);
  record.time = std::move(time);
  record.sample_time = 1 / rate_hz;
  record.notes.push_back("resampled to " + format_number(rate_hz, 9) +
                         " Hz by linear interpolation, as stated");
}

std::pair<std::size_t, std::size_t> moving_part(std::span<const double> time,
                                                std::span<const double> motion) {
  constexpr double kRest = 0.3, kShare = 0.02;
  const auto [low, high] = std::minmax_element(motion.begin(), motion.end());
  const double threshold = kShare * 0.5 * (*high - *low);
  std::size_t first = 0, last = motion.size();
  while (first < last && std::abs(motion[first] - motion.front()) <= threshold) ++first;
  if (first == last) return {0, motion.size()};
  while (last > first && std::abs(motion[last - 1] - motion.back()) <= threshold) --last;
  if (time[first] - time.front() < kRest) first = 0;
  if (time.back() - time[last - 1] < kRest) last = motion.size();
  return {first, last};
}

}  // namespace dashpot
