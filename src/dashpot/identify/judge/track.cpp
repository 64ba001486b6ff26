#include "dashpot/identify/judge/track.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/inverse/observer.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr double kWarmUp = 0.1;       // s
constexpr int kRangeCurrents = 17;    // from the least to the greatest
constexpr double kRangeSlack = 1e-6;  // of the wanted force's span: a force on the edge is in reach
constexpr double kAtLimit = 1e-9;     // of the current range

/// Appends the least and the greatest force that a current could give now.
void add_range(const Observer& observer, const InverseInput& input, const InverseLimits& limits,
               std::span<double> state, TrackReport& report) {
  double least = INFINITY, greatest = -INFINITY;
  for (int k = 0; k < kRangeCurrents; ++k) {
    const double share = static_cast<double>(k) / (kRangeCurrents - 1);
    const double force = observer.force(
        limits.current_min + share * (limits.current_max - limits.current_min), input, state);
    least = std::min(least, force);
    greatest = std::max(greatest, force);
  }
  report.least.push_back(least);
  report.greatest.push_back(greatest);
}

void score(TrackReport& report, const InverseLimits& limits) {
  const auto [low, high] = std::minmax_element(report.wanted.begin(), report.wanted.end());
  report.span = *high - *low;

  // Errors over all samples and over those in reach; and how often the command is at a limit.
  const double slack = kAtLimit * (limits.current_max - limits.current_min);
  ErrorSums all, reachable;
  double saturated = 0;
  for (std::size_t k = report.warm_up; k < report.time.size(); ++k) {
    all.add(report.wanted[k], report.obtained[k]);
    if (report.is_reachable(k)) reachable.add(report.wanted[k], report.obtained[k]);
    saturated += report.command[k] <= limits.current_min + slack ||
                 report.command[k] >= limits.current_max - slack;
  }

  // Both are given in per cent of the same span.
  all.force_min = reachable.force_min = *low;
  all.force_max = reachable.force_max = *high;
  report.all = metrics(all);
  if (reachable.n > 0) report.reachable = metrics(reachable);
  report.reachable_share = 100.0 * static_cast<double>(reachable.n) / static_cast<double>(all.n);
  report.saturated_share = 100.0 * saturated / static_cast<double>(all.n);
}

}  // namespace

bool TrackReport::is_reachable(std::size_t k) const {
  const double slack = kRangeSlack * span;
  return wanted[k] >= least[k] - slack && wanted[k] <= greatest[k] + slack;
}

InverseLimits limits_of(const DriverOptions& driver, double sample_time) {
  return {driver.current_min, driver.current_max, sample_time, driver.lag_rate};
}

DriverOptions driver_of(const DamperModel& damper, DriverOptions options) {
  if (options.lag_rate == 0) options.lag_rate = without_coil_lag(damper).lag_rate;
  return options;
}

TrackReport track(const DamperModel& damper, const InverseModel& inverse, const Driver& driver,
                  const Motion& motion, const std::vector<double>& wanted) {
  if (wanted.size() != motion.size() || wanted.size() < 2)
    throw Error("track",
                "the wanted force and the motion differ in length, or have no two samples");

  // The coil's lag is the driver's: the damper runs without its own.
  const double h = motion.sample_time;
  const BareDamper bare = without_coil_lag(damper);
  const InverseLimits limits = limits_of(driver.options(), h);
  const Observer observer(*bare.model, limits);
  std::vector<double> state(observer.state_size()), memory(inverse.state_size()),
      coil(Driver::kStates);
  const std::span<double> z = std::span(state).first(bare.model->state_size());

  TrackReport report;
  report.wanted = wanted;
  report.warm_up = std::min(wanted.size() - 2, static_cast<std::size_t>(kWarmUp / h));

  // Everything starts at rest at the least current.
  DamperInput now{motion.displacement[0], motion.velocity[0], limits.current_min};
  bare.model->rest(now, z);
  inverse.rest(now, memory);
  driver.rest(limits.current_min, coil);

  for (std::size_t k = 0; k < motion.size(); ++k) {
    // The inverse commands, the coil follows, the damper answers.
    const InverseInput input{wanted[k], now.displacement, now.velocity, now.current,
                             bare.model->force(now, z)};
    report.time.push_back(static_cast<double>(k) * h);
    report.command.push_back(inverse.command(input, memory));
    driver.command(report.command.back(), coil);
    now.current = driver.current(coil);
    report.current.push_back(now.current);
    report.obtained.push_back(bare.model->force(now, z));
    add_range(observer, input, limits, state, report);
    if (k + 1 == motion.size()) break;

    // On to the next sample.
    driver.advance(h, coil);
    const DamperInput next{motion.displacement[k + 1], motion.velocity[k + 1],
                           driver.current(coil)};
    bare.model->advance(now, next, h, z);
    now = next;
  }
  score(report, limits);
  return report;
}

}  // namespace dashpot
