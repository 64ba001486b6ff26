#include "dashpot/record/time_base.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/median.h"

namespace dashpot {
namespace {

bool whole(double value) {
  return std::abs(value - std::round(value)) <= 1e-6 + 4e-16 * std::abs(value);
}

/// The power of ten to which the stamps are printed, or 0 when they have all their digits.
double printed_digit(std::span<const double> stamps) {
  const auto looked_at = stamps.first(std::min<std::size_t>(stamps.size(), 5000));
  for (double scale = 1; scale < 1e10; scale *= 10)
    if (std::all_of(looked_at.begin(), looked_at.end(), [&](double t) { return whole(t * scale); }))
      return 1 / scale;
  return 0;
}

/// The power of ten of numbers. Those that follow each other, as stamps do, mostly share one.
class PowersOfTen {
 public:
  double of(double t) {
    const double size = std::abs(t);
    if (size > least_ && size < most_) return power_;
    if (t == 0) return 1e-300;
    power_ = std::pow(10.0, std::floor(std::log10(size)));

    // The next ones are not so close to another power that rounding would decide.
    constexpr double kApart = 1e-9;
    least_ = power_ * (1 + kApart);
    most_ = 10 * power_ * (1 - kApart);
    return power_;
  }

 private:
  double power_ = 0, least_ = 0, most_ = 0;
};

/// To how many significant digits the stamps are printed (0.0003328 ... 24.6496: 6), or 0 for all.
int significant_digits(std::span<const double> stamps) {
  PowersOfTen power;
  for (int digits = 3; digits < 10; ++digits) {
    const double scale = std::pow(10.0, digits - 1);
    if (std::all_of(stamps.begin(), stamps.end(),
                    [&](double t) { return whole(t / power.of(t) * scale); }))
      return digits;
  }
  return 0;
}

/// Whether the stamps were kept in single precision, as loggers and arrays do.
bool single_precision(std::span<const double> stamps) {
  return std::ranges::all_of(
      stamps, [](double t) { return static_cast<double>(static_cast<float>(t)) == t; });
}

/// Distance of neighbouring numbers of single precision at t.
double single_spacing(double t) {
  const float size = std::abs(static_cast<float>(t));
  return static_cast<double>(std::nextafter(size, INFINITY) - size);
}

struct Line {
  double start = 0, step = 0;
};

/// Least-squares line through stamp over index. Sums in long double: 1e8 stamps lose 1e-9 s
/// otherwise.
Line fit_line(std::span<const double> stamps) {
  const auto n = static_cast<long double>(stamps.size());
  const long double middle = (n - 1) / 2;
  long double sum = 0, product = 0;
  for (std::size_t k = 0; k < stamps.size(); ++k) {
    const long double t = static_cast<long double>(stamps[k]) - stamps[0];
    sum += t;
    product += (static_cast<long double>(k) - middle) * t;
  }
  const long double step = product / (n * (n * n - 1) / 12);
  return {stamps[0] + static_cast<double>(sum / n - step * middle), static_cast<double>(step)};
}

/// A rate that is a whole number of hertz, or a step with the printed digits, when the fit allows
/// it.
double snapped(double step, double tolerance, double digit) {
  const double rate = std::round(1 / step);
  if (rate >= 1 && std::abs(1 / rate - step) <= tolerance) return 1 / rate;
  if (digit > 0) {
    const double scale = std::round(1 / digit), steps = std::round(step * scale);
    if (steps >= 1 && std::abs(steps / scale - step) <= tolerance) return steps / scale;
  }
  return step;
}

/// Straight lines between the values; both grids ascend.
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

/// What stands below a stamp that runs backwards, and what to do with it.
std::pair<std::string, std::string> told_of_return(std::span<const double> stamps, std::size_t at,
                                                   const RawTable& table) {
  const double step = std::abs(stamps[1] - stamps[0]);
  if (std::abs(stamps[at] - stamps[0]) <= 1.5 * step)
    return {", where another recording seems to begin", "give each recording a file of its own"};

  // Rows that are there already: a buffer that was written twice.
  const auto before = stamps.first(at);
  const auto same = std::ranges::find(before, stamps[at]);
  if (same == before.end()) return {"", "sort the rows, or leave out those that do not belong"};
  const auto row = static_cast<std::size_t>(same - before.begin());
  const bool repeats = std::ranges::all_of(table.columns, [&](const RawColumn& column) {
    return column.values.size() <= at || column.values[row] == column.values[at];
  });
  if (!repeats) return {"", "sort the rows, or leave out those that do not belong"};
  return {": the row is that of " + table.where(row) + " again",
          "leave out the rows that are there twice"};
}

}  // namespace

double uniform_step(std::span<const double> stamps) {
  if (stamps.size() < 2) return 0;
  const Line line = fit_line(stamps);

  // To what are the stamps rounded: a fixed decimal place, so many significant digits, whose place
  // grows with the stamp, or single precision, which does so in powers of two?
  const double digit = printed_digit(stamps);
  const int digits = digit > 0 ? significant_digits(stamps) : 0;
  const double least_share = std::pow(10.0, 1 - digits);  // of a stamp's power of ten
  const bool single = digit == 0 && single_precision(stamps);
  PowersOfTen power;
  const auto place = [&](double t) {
    if (single) return single_spacing(t);
    return digits > 0 ? std::max(digit, least_share * power.of(t)) : digit;
  };
  // Coarse digits (0 1 2 4 5) cannot show that a gap is rounding: then only an exact grid is
  // uniform.
  const bool rounded = place(stamps.back()) < 0.5 * line.step;
  const auto tolerance = [&](double t) {
    return (rounded ? 0.6 * place(t) : 0) + 1e-6 * line.step + 1e-15 * std::abs(t);
  };

  // All stamps must lie on the line within that rounding.
  for (std::size_t k = 0; k < stamps.size(); ++k)
    if (std::abs(stamps[k] - (line.start + line.step * static_cast<double>(k))) >
        tolerance(stamps[k]))
      return 0;
  return snapped(line.step, 2 * tolerance(stamps.back()) / static_cast<double>(stamps.size() - 1),
                 digit);
}

void require_increasing(std::span<const double> stamps, const RawTable& table) {
  for (std::size_t k = 1; k < stamps.size(); ++k) {
    if (stamps[k] > stamps[k - 1]) continue;
    const std::string now = format_number(stamps[k], 10), before = format_number(stamps[k - 1], 10);
    if (stamps[k] == stamps[k - 1])
      throw Error(table.where(k), "time " + now + " is repeated",
                  "time must increase; where its digits are too few and no sample is missing, "
                  "state its sample_rate in a dataset file");
    const auto [what, right] = told_of_return(stamps, k, table);
    throw Error(table.where(k), "time runs backwards: " + now + " after " + before + what,
                "time must increase: " + right);
  }
}

double usual_step(std::span<const double> stamps) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < stamps.size(); ++k) steps.push_back(stamps[k] - stamps[k - 1]);
  return median(std::move(steps));
}

LostSamples lost_samples(std::span<const double> stamps) {
  constexpr double kAlike = 0.1;  // of a step
  LostSamples lost;
  if (stamps.size() < 3) return lost;
  const double step = usual_step(stamps);
  for (std::size_t k = 1; k < stamps.size(); ++k) {
    const double steps = (stamps[k] - stamps[k - 1]) / step, whole = std::round(steps);
    if (whole < 1 || std::abs(steps - whole) > kAlike) return {};
    if (whole < 2) continue;
    lost.samples += static_cast<std::size_t>(whole) - 1;
    if (lost.places++ == 0) lost.first_behind = stamps[k - 1];
  }
  return lost;
}

std::string describe(const LostSamples& lost) {
  if (lost.places == 0) return {};
  const bool is_one = lost.samples == 1;
  return std::to_string(lost.samples) + (is_one ? " sample is" : " samples are") + " missing" +
         (is_one             ? ""
          : lost.places == 1 ? " in one place"
                             : " in " + std::to_string(lost.places) + " places") +
         " by the time stamps, " + (lost.places > 1 ? "the first " : "") + "behind " +
         format_number(lost.first_behind, 6) + " s";
}

void make_uniform(std::span<double> stamps, double start, double sample_time) {
  // By division where the rate is whole: 3 / 1000.0 is the number that people write as 0.003.
  const double rate = std::round(1 / sample_time);
  const bool whole = rate >= 1 && 1 / rate == sample_time;
  for (std::size_t k = 0; k < stamps.size(); ++k)
    stamps[k] =
        start + (whole ? static_cast<double>(k) / rate : static_cast<double>(k) * sample_time);
}

void resample(Record& record, double rate_hz) {
  const double duration = record.time.back() - record.time.front();
  const double count = std::floor(duration * rate_hz * (1 + 1e-12)) + 1;

  if (!(count >= 2 && count <= 1e9))
    throw Error(record.name, "resampling to " + format_number(rate_hz) + " Hz gives " +
                                 format_number(count, 12) + " samples");

  std::vector<double> time(static_cast<std::size_t>(count));
  make_uniform(time, record.time.front(), 1 / rate_hz);
  for (Channel& channel : record.channels)
    channel.samples = interpolate(record.time, channel.samples, time);
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

  // Walk inwards from both ends while the signal stays near its value there.
  std::size_t first = 0, last = motion.size();
  while (first < last && std::abs(motion[first] - motion.front()) <= threshold) ++first;
  if (first == last) return {0, motion.size()};
  while (last > first && std::abs(motion[last - 1] - motion.back()) <= threshold) --last;

  // Rest that is shorter than this may be a turning point: keep it.
  if (time[first] - time.front() < kRest) first = 0;
  if (time.back() - time[last - 1] < kRest) last = motion.size();
  return {first, last};
}

}  // namespace dashpot
