#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace dashpot {

// A chart that follows one number over days and says when it has fallen: a self-starting CUSUM.
// Sources: E. S. Page, Biometrika 41, 1954 (cumulative sums); D. M. Hawkins, The Statistician 36,
// 1987 (self-starting); R. L. Brown, J. Durbin, J. M. Evans, J. R. Statist. Soc. B 37, 1975
// (recursive residuals); D. Brook, D. A. Evans, Biometrika 59, 1972 (run lengths).
//
// How much the number scatters from one healthy day to the next is not assumed but learnt from the
// days before. A day's value less what the days before (and what is known of the day, such as its
// temperature) led to expect, over its scatter, follows Student's t; the quantile of the normal
// distribution at the same probability is the day's score. Where healthy days are independent and
// normally distributed, scores are so too, exactly, from few days on: the rate of false alarms is
// that which is stated, although mean and scatter are estimates.

/// A score counts in the sums up to this much: one odd day does not make an alarm.
constexpr double kMostScore = 3;

/// Mean number of days until an alarm of max(0, sum - score - allowance) > threshold, where scores
/// are normal and held within kMostScore; and the threshold at which it is `days`.
double cusum_run_length(double allowance, double threshold);
double cusum_threshold(double allowance, double days);

/// What a chart is made of: a day's value, and what is known of the day, which may explain it.
struct ChartDay {
  double value = 0;
  /// As many for each day. One that has been the same on all days before explains nothing; a day on
  /// which it is another for the first time is not judged, and teaches.
  std::vector<double> known;
  bool counts = true;  ///< else it neither teaches nor is judged
};

struct ChartOptions {
  std::size_t reference = 20;  ///< days that count and only teach; at least fewest_reference_days()
  double days = 1000;          ///< between false alarms, mean
  double shift = 1;            ///< scatters: the fall that is to be found soonest
  double threshold = 0;        ///< of the sum; 0: that of `days`
};

struct ChartPoint {
  double score = 0;  ///< 0 of the days that are not judged
  bool is_judged = false;
  double sum = 0;       ///< of CUSUM
  double expected = 0;  ///< of the value, by the days before
  double scatter = 0;   ///< standard deviation of the value about it
};

struct Chart {
  double threshold = 0;
  std::vector<ChartPoint> points;    ///< one per day
  std::optional<std::size_t> alarm;  ///< the first day of it; it stands, and no later day teaches
  /// Where there is an alarm: the day at which the fall most likely began, and the fall since, the
  /// mean over these days of expected less value, with its standard deviation.
  std::size_t since = 0;
  double fall = 0, fall_deviation = 0;
};

/// The fewest days that can teach a chart with so many known numbers per day.
std::size_t fewest_reference_days(std::size_t known);

/// options.reference must be enough.
Chart health_chart(std::span<const ChartDay> days, const ChartOptions& options);

}  // namespace dashpot
