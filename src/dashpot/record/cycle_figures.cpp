#include "dashpot/record/cycle_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/median.h"
#include "dashpot/record/integrate.h"

namespace dashpot {
namespace {

constexpr double kMiddle = 0.1;      // of the stroke, to either side of its middle
constexpr double kRateRange = 0.35;  // likewise, for the slope over the stroke
constexpr std::size_t kRateBins = 16;
constexpr std::size_t kSmoothing = 50;  // a peak is smoothed over this part of its stroke
constexpr double kStrokesAlike = 0.1, kTimesAlike = 0.3;
constexpr std::size_t kLeastSamples = 12;  // of a stroke
constexpr double kCyclicShare = 0.4;       // of the strokes that must belong to cycles ...
constexpr std::size_t kFewStrokes = 6;     // ... in a record of more than so few
constexpr double kSpeedsAlike = 0.05;
constexpr double kAtRest = 0.05;  // of the greatest speed: a record may begin or end in a reversal
constexpr double kLeastTemperatureSpan = 2;  // K

double mean(std::span<const double> samples) {
  return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

/// Slope and value at u = 0 of the least-squares line.
struct Regression {
  double value = 0, slope = 0;
};
Regression regression_of(std::span<const double> u, std::span<const double> y) {
  const double centre = mean(u), level = mean(y);
  double uu = 0, uy = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    uu += (u[k] - centre) * (u[k] - centre);
    uy += (u[k] - centre) * (y[k] - level);
  }
  const double slope = uu > 0 ? uy / uu : 0;
  return {level - slope * centre, slope};
}

/// The samples of a stroke, in one direction of motion.
struct OneWay {
  std::size_t first, last;
  double sign;  // 1: extension
  std::size_t count() const { return last - first + 1; }
};

StrokeFigures figures_of_stroke(const DynoChannels& c, const OneWay& stroke) {
  const double centre = (c.displacement[stroke.first] + c.displacement[stroke.last]) / 2,
               length = std::abs(c.displacement[stroke.last] - c.displacement[stroke.first]);

  // A line through the middle of the stroke, of a window that grows until it has some samples.
  StrokeFigures figures;
  std::vector<double> x, v, f;
  for (double share = kMiddle; x.size() < 4 && share < 0.5; share *= 1.5) {
    x.clear(), v.clear(), f.clear();
    for (std::size_t k = stroke.first; k <= stroke.last; ++k) {
      if (std::abs(c.displacement[k] - centre) > share * length) continue;
      x.push_back(c.displacement[k] - centre);
      v.push_back(stroke.sign * c.velocity[k]);
      f.push_back(c.force[k]);
    }
  }
  figures.mid_speed = regression_of(x, v).value;
  figures.mid_force = regression_of(x, f).value;

  // The peaks, of a moving mean.
  const std::size_t width = std::max<std::size_t>(1, stroke.count() / kSmoothing);
  double best_speed = 0, best_force = -std::numeric_limits<double>::infinity();
  for (std::size_t k = stroke.first; k + width <= stroke.last + 1; ++k) {
    best_speed = std::max(best_speed, stroke.sign * mean(c.velocity.subspan(k, width)));
    best_force = std::max(best_force, stroke.sign * mean(c.force.subspan(k, width)));
  }
  figures.peak_speed = best_speed;
  figures.peak_force = stroke.sign * best_force;
  return figures;
}

/// Slope, at the middle, of the mean of both directions' forces at equal displacement, from the
/// means over equal parts of the middle of the stroke.
double rate_of(const DynoChannels& c, const CycleFigures& cycle) {
  std::array<std::array<double, kRateBins>, 2> sums{}, counts{};
  const double range = kRateRange * cycle.stroke;
  const auto add = [&](std::size_t from, std::size_t to, std::size_t direction) {
    for (std::size_t k = from; k <= to; ++k) {
      const double share = (c.displacement[k] - cycle.centre + range) / (2 * range);
      if (!(share >= 0 && share < 1)) continue;
      const auto bin = static_cast<std::size_t>(share * kRateBins);
      sums[direction][bin] += c.force[k];
      counts[direction][bin] += 1;
    }
  };
  add(cycle.first, cycle.middle, 0);
  add(cycle.middle, cycle.last, 1);

  // An odd cubic, since a gas spring stiffens; parts that lie as far on either side of the middle
  // keep the even terms (asymmetry of the valves) out of it.
  double uu = 0, uuu = 0, cubes = 0, uy = 0, uuy = 0;
  for (std::size_t bin = 0; bin < kRateBins; ++bin) {
    const std::size_t mirror = kRateBins - 1 - bin;
    if (counts[0][bin] * counts[1][bin] * counts[0][mirror] * counts[1][mirror] == 0) continue;
    const double u = (static_cast<double>(bin) + 0.5) / kRateBins * 2 - 1,
                 y = (sums[0][bin] / counts[0][bin] + sums[1][bin] / counts[1][bin]) / 2;
    uu += u * u;
    uuu += std::pow(u, 4);
    cubes += std::pow(u, 6);
    uy += u * y;
    uuy += u * u * u * y;
  }
  const double determinant = uu * cubes - uuu * uuu;
  return determinant > 1e-9 * uu * cubes ? (uy * cubes - uuy * uuu) / determinant / range
                                         : kNoNumber;
}

/// Mean force of a direction where its speed lies between two shares of the
/// mid-stroke speed, apart for growing and falling speed.
struct Branches {
  double count[2] = {0, 0}, speed[2] = {0, 0}, force[2] = {0, 0};
  bool has_both() const { return count[0] > 0 && count[1] > 0; }
};
Branches branches_of(const DynoChannels& c, const OneWay& stroke, double centre, double low,
                     double high) {
  Branches b;
  for (std::size_t k = stroke.first; k <= stroke.last; ++k) {
    const double speed = stroke.sign * c.velocity[k];
    if (speed < low || speed >= high) continue;
    const std::size_t falling = stroke.sign * (c.displacement[k] - centre) > 0 ? 1 : 0;
    b.count[falling] += 1;
    b.speed[falling] += speed;
    b.force[falling] += stroke.sign * c.force[k];
  }
  for (int i = 0; i < 2; ++i)
    for (double* value : {&b.speed[i], &b.force[i]}) *value /= b.count[i];
  return b;
}

double hysteresis_of(const DynoChannels& c, const CycleFigures& cycle) {
  double sum = 0;
  for (const OneWay& stroke :
       {OneWay{cycle.first, cycle.middle, 1}, OneWay{cycle.middle, cycle.last, -1}}) {
    const double speed = (stroke.sign > 0 ? cycle.rebound : cycle.compression).mid_speed;

    // Force without the rate's part at half of the speed, by a line through a window around it.
    std::vector<double> v[2], f[2];
    for (std::size_t k = stroke.first; k <= stroke.last; ++k) {
      const double share = stroke.sign * c.velocity[k] / speed,
                   from_middle = c.displacement[k] - cycle.centre;
      if (share < 0.3 || share > 0.7) continue;
      const std::size_t falling = stroke.sign * from_middle > 0 ? 1 : 0;
      v[falling].push_back(share - 0.5);
      f[falling].push_back(stroke.sign * (c.force[k] - cycle.rate * from_middle));
    }
    if (v[0].size() < 2 || v[1].size() < 2) return kNoNumber;
    sum += regression_of(v[1], f[1]).value - regression_of(v[0], f[0]).value;
  }
  return sum / 2;
}

double energy_of(const DynoChannels& c, const CycleFigures& cycle) {
  double energy = 0;
  for (std::size_t k = cycle.first + 1; k <= cycle.last; ++k)
    energy += 0.5 * (c.force[k] * c.velocity[k] + c.force[k - 1] * c.velocity[k - 1]) *
              (c.time[k] - c.time[k - 1]);
  return energy;
}

/// Cycles of a record grouped by speed: the numbers of each group's cycles.
std::vector<std::vector<std::size_t>> groups_by_speed(const std::vector<CycleFigures>& cycles) {
  std::vector<std::size_t> order(cycles.size());
  std::iota(order.begin(), order.end(), 0);
  const auto speed = [&](std::size_t k) {
    return (cycles[k].rebound.mid_speed + cycles[k].compression.mid_speed) / 2;
  };
  std::ranges::stable_sort(order, {}, speed);
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t k : order) {
    if (groups.empty() || speed(k) > speed(groups.back().front()) * (1 + kSpeedsAlike))
      groups.emplace_back();
    groups.back().push_back(k);
  }
  return groups;
}

/// Slope of the damping force, in % of its mean at that speed, over some quantity of a cycle; each
/// speed has its own mean of both.
Measured common_slope(const std::vector<CycleFigures>& cycles, double CycleFigures::* quantity) {
  // Quantity and force of each cycle, as they differ from the means of its group.
  std::vector<double> u, y;
  double groups = 0;
  for (const auto& group : groups_by_speed(cycles)) {
    if (group.size() < 2) continue;
    double level = 0, centre = 0;
    for (const std::size_t k : group) {
      level += cycles[k].damping_force / static_cast<double>(group.size());
      centre += cycles[k].*quantity / static_cast<double>(group.size());
    }
    for (const std::size_t k : group) {
      u.push_back(cycles[k].*quantity - centre);
      y.push_back(100 * (cycles[k].damping_force / level - 1));
    }
    ++groups;
  }

  // One line through all of them, which passes through 0.
  const double left = static_cast<double>(u.size()) - groups - 1;
  double uu = 0, uy = 0, squares = 0;
  for (std::size_t k = 0; k < u.size(); ++k) uu += u[k] * u[k], uy += u[k] * y[k];
  if (left < 2 || !(uu > 0)) return {};
  for (std::size_t k = 0; k < u.size(); ++k)
    squares += (y[k] - uy / uu * u[k]) * (y[k] - uy / uu * u[k]);
  return {uy / uu, std::sqrt(squares / left / uu)};
}

double repeatability_of(const std::vector<CycleFigures>& cycles) {
  double squares = 0, freedom = 0;
  for (const auto& group : groups_by_speed(cycles)) {
    if (group.size() < 2) continue;
    double level = 0;
    for (const std::size_t k : group)
      level += cycles[k].damping_force / static_cast<double>(group.size());
    for (const std::size_t k : group)
      squares += std::pow(100 * (cycles[k].damping_force / level - 1), 2);
    freedom += static_cast<double>(group.size() - 1);
  }
  return freedom > 0 ? std::sqrt(squares / freedom) : kNoNumber;
}

/// Strokes in whose middle half the force jumps, or the rod stops.
std::string stick_slip_remark(const DynoChannels& c, const std::vector<CycleFigures>& cycles) {
  // What a sample differs from the mean of its neighbours, against the usual difference.
  std::vector<double> differences;
  struct Middle {
    std::size_t first, last;
    double peak, speed;
  };
  std::vector<Middle> middles;
  for (const CycleFigures& cycle : cycles)
    for (const auto& [from, to, figures] :
         {std::tuple{cycle.first, cycle.middle, cycle.rebound},
          std::tuple{cycle.middle, cycle.last, cycle.compression}}) {
      const std::size_t quarter = (to - from) / 4;
      middles.push_back({from + std::max<std::size_t>(quarter, 2),
                         to - std::max<std::size_t>(quarter, 2), std::abs(figures.peak_force),
                         figures.mid_speed});
    }
  const auto difference = [&](std::size_t k) {
    return std::abs(c.force[k] - (c.force[k - 2] + c.force[k + 2]) / 2);
  };
  for (const Middle& m : middles)
    for (std::size_t k = m.first; k <= m.last; ++k) differences.push_back(difference(k));
  const double usual = 1.4826 * median(differences);

  std::size_t jumps = 0, stops = 0;
  for (const Middle& m : middles) {
    bool jumped = false, stopped = false;
    for (std::size_t k = m.first; k <= m.last; ++k) {
      jumped = jumped || difference(k) > std::max(8 * usual, 0.05 * m.peak);
      stopped = stopped || std::abs(c.velocity[k]) < 0.1 * m.speed;
    }
    jumps += jumped ? 1 : 0;
    stops += stopped ? 1 : 0;
  }
  if (stops > 0)
    return fmt::format(
        "the rod stops within {} of {} strokes (stick-slip, or a pause): mid-stroke "
        "forces there are means over it",
        stops, middles.size());
  if (10 * jumps > middles.size())
    return fmt::format(
        "the force jumps in the middle of {} of {} strokes (stick-slip, or spikes): "
        "mid-stroke forces are means through the jumps",
        jumps, middles.size());
  return {};
}

/// What can still be said of a motion that has no cycles.
std::string told_without_cycles(const DynoChannels& c) {
  const auto [least, greatest] = std::ranges::minmax(c.force);
  double fastest = 0;
  for (const double v : c.velocity) fastest = std::max(fastest, std::abs(v));
  return fmt::format("what can be told: force {:.0f} ... {:.0f} N, speed up to {:.3g} mm/s", least,
                     greatest, 1000 * fastest);
}

/// How many cycles are no part of the figures, and why; "" where none was left out.
std::string left_out_remark(std::size_t unlike) {
  if (unlike == 0) return {};
  return fmt::format(
      "{} left out: the two strokes differ by more than {:g} % in length or {:g} % in time",
      counted(unlike, "cycle"), 100 * kStrokesAlike, 100 * kTimesAlike);
}

}  // namespace

double noise_of(std::span<const double> samples) {
  if (samples.size() < 3) return 0;
  std::vector<double> differences;
  for (std::size_t k = 1; k + 1 < samples.size(); ++k)
    differences.push_back(std::abs(samples[k + 1] - 2 * samples[k] + samples[k - 1]));
  return 1.4826 * median(std::move(differences)) / std::sqrt(6.0);
}

std::vector<std::size_t> turning_points(const std::vector<double>& displacement, double least) {
  std::vector<std::size_t> points;
  std::size_t low = 0, high = 0;
  int direction = 0;  // of the stroke under way; 0: not known yet
  for (std::size_t k = 1; k < displacement.size(); ++k) {
    if (displacement[k] < displacement[low]) low = k;
    if (displacement[k] > displacement[high]) high = k;

    // A turning point counts once the motion has left it by more than `least`.
    if (direction >= 0 && displacement[high] - displacement[k] > least) {
      points.push_back(high);
      direction = -1;
      low = k;
      high = k;
    } else if (direction <= 0 && displacement[k] - displacement[low] > least) {
      points.push_back(low);
      direction = 1;
      low = k;
      high = k;
    }
    if (direction > 0) low = high;
    if (direction < 0) high = low;
  }
  if (direction != 0) points.push_back(direction > 0 ? high : low);
  return points;
}

CycleFigures figures_of_cycle(const DynoChannels& c, std::size_t first, std::size_t middle,
                              std::size_t last) {
  CycleFigures cycle;
  cycle.first = first;
  cycle.middle = middle;
  cycle.last = last;
  const auto& x = c.displacement;
  cycle.start = c.time[first];
  cycle.duration = c.time[last] - c.time[first];
  cycle.stroke = x[middle] - (x[first] + x[last]) / 2;
  cycle.centre = (x[middle] + (x[first] + x[last]) / 2) / 2;
  const std::size_t count = last - first + 1;
  cycle.drive = c.drive.empty() ? kNoNumber : mean(c.drive.subspan(first, count));
  cycle.temperature = c.temperature.empty() ? kNoNumber : mean(c.temperature.subspan(first, count));

  // Each direction by itself, then what their forces have in common and what not.
  cycle.rebound = figures_of_stroke(c, {first, middle, 1});
  cycle.compression = figures_of_stroke(c, {middle, last, -1});
  cycle.damping_force = (cycle.rebound.mid_force - cycle.compression.mid_force) / 2;
  cycle.static_force = -(cycle.rebound.mid_force + cycle.compression.mid_force) / 2;
  cycle.rate = rate_of(c, cycle);
  cycle.hysteresis = hysteresis_of(c, cycle);

  // E = pi c w X^2 for a dashpot c in a sine of amplitude X and angular frequency w.
  cycle.energy = energy_of(c, cycle);
  cycle.equivalent_damping = cycle.energy * cycle.duration * 2 /
                             (std::numbers::pi * std::numbers::pi * cycle.stroke * cycle.stroke);
  return cycle;
}

void add_mean_loop(const DynoChannels& c, const CycleFigures& cycle, double sign, MeanLoop& loop) {
  constexpr int kBins = 24;
  constexpr double kLow = 0.06, kHigh = 0.98;
  const OneWay stroke =
      sign > 0 ? OneWay{cycle.first, cycle.middle, 1} : OneWay{cycle.middle, cycle.last, -1};
  const double speed = (sign > 0 ? cycle.rebound : cycle.compression).mid_speed;
  for (int bin = 0; bin < kBins; ++bin) {
    const double low = speed * (kLow + (kHigh - kLow) * bin / kBins),
                 high = speed * (kLow + (kHigh - kLow) * (bin + 1) / kBins);
    const Branches b = branches_of(c, stroke, cycle.centre, low, high);
    if (!b.has_both()) continue;
    loop.speed.push_back((b.speed[0] + b.speed[1]) / 2);
    loop.force.push_back((b.force[0] + b.force[1]) / 2);
  }
  loop.ends.push_back(loop.speed.size());
}

DynoChannels dyno_channels(const Record& record, DriveUnit drive_unit,
                           std::vector<double>& integrated) {
  DynoChannels c{.time = record.time,
                 .displacement = {},
                 .velocity = record.channel("velocity").samples,
                 .force = record.channel("force").samples,
                 .drive = {},
                 .temperature = {}};

  // A displacement that was not recorded is integrated.
  if (const Channel* displacement = record.find("displacement")) {
    c.displacement = displacement->samples;
  } else {
    if (record.sample_time <= 0)
      throw Error("record '" + record.name + "'",
                  "has no displacement, and its samples are not evenly spaced in time",
                  "a displacement, or an even sample time");
    integrated = integrate_without_drift(c.velocity, record.sample_time).x;
    c.displacement = integrated;
  }

  if (drive_unit != DriveUnit::None)
    if (const Channel* drive = record.find(drive_channel(drive_unit))) c.drive = drive->samples;
  if (const Channel* temperature = record.find("temperature")) c.temperature = temperature->samples;
  return c;
}

RecordFigures figures_of_record(const Record& record, DriveUnit drive_unit) {
  RecordFigures figures;
  figures.name = record.name;
  figures.condition = record.condition;
  figures.drive_level = record.drive_level;
  std::vector<double> integrated;
  DynoChannels c;
  record.channel("force");
  try {
    c = dyno_channels(record, drive_unit, integrated);
  } catch (const Error& error) {
    figures.remarks.push_back(std::string("no cycles: ") + error.what());
    return figures;
  }
  if (!integrated.empty())
    figures.remarks.push_back("displacement was integrated from velocity: strokes without drift");

  // Motion that is more than noise, between turning points.
  const auto [lowest, highest] = std::ranges::minmax(c.displacement);
  const double span = highest - lowest, noise = noise_of(c.displacement);
  if (!(span > 12 * noise) || span <= 0) {
    figures.remarks.push_back(
        fmt::format("at rest: it moves by {:.3g} mm, no more than its noise; nothing can be told",
                    1000 * span));
    return figures;
  }
  const std::vector<std::size_t> points = turning_points(
      {c.displacement.begin(), c.displacement.end()}, std::max(8 * noise, 0.02 * span));

  // Cycles: an extension and a compression of one length and one duration.
  const auto alike = [](double a, double b, double share) {
    return std::abs(a - b) <= share * std::max(std::abs(a), std::abs(b));
  };
  const double fastest = std::ranges::max(c.velocity, {}, [](double v) { return std::abs(v); });
  const auto cut_off = [&](std::size_t k) {
    return (k == 0 || k + 1 == record.size()) &&
           std::abs(c.velocity[k]) > kAtRest * std::abs(fastest);
  };
  std::size_t coarse = 0, unlike = 0;
  for (std::size_t k = 0; k + 2 < points.size(); ++k) {
    const std::size_t a = points[k], b = points[k + 1], e = points[k + 2];
    const double up = c.displacement[b] - c.displacement[a],
                 down = c.displacement[b] - c.displacement[e];
    if (up < 0 || cut_off(a) || cut_off(e)) continue;
    if (!alike(up, down, kStrokesAlike) ||
        !alike(c.time[b] - c.time[a], c.time[e] - c.time[b], kTimesAlike)) {
      ++unlike;
      continue;
    }
    if (std::min(b - a, e - b) < kLeastSamples) {
      ++coarse;
      continue;
    }
    figures.cycles.push_back(figures_of_cycle(c, a, b, e));
    ++k;  // The next cycle begins with the next extension.
  }

  // Without cycles, or with a few by chance, say why.
  const std::size_t strokes = points.empty() ? 0 : points.size() - 1;
  if (coarse > 0)
    figures.remarks.push_back(
        fmt::format("{} of fewer than {} samples per stroke left out: "
                    "sample faster to characterise them",
                    counted(coarse, "cycle"), kLeastSamples));
  if (strokes > kFewStrokes && coarse == 0 &&
      2 * static_cast<double>(figures.cycles.size()) <
          kCyclicShare * static_cast<double>(strokes)) {
    figures.remarks.push_back(fmt::format(
        "the motion is not cyclic but random: only {} of {} strokes return alike, so "
        "forces at stated speeds, knee, friction, gas force and repeatability cannot be told",
        2 * figures.cycles.size(), strokes));
    figures.remarks.push_back(told_without_cycles(c));
    figures.cycles.clear();
  } else if (figures.cycles.empty() && coarse == 0) {
    figures.remarks.push_back(
        fmt::format("no whole cycle between turning points, only {}: record at least two cycles",
                    counted(strokes, "stroke")));
    figures.remarks.push_back(told_without_cycles(c));
  }
  if (figures.cycles.empty()) return figures;
  if (std::string remark = left_out_remark(unlike); !remark.empty())
    figures.remarks.push_back(std::move(remark));

  // How the cycles repeat, and what goes on over time and temperature.
  figures.repeatability = repeatability_of(figures.cycles);
  figures.drift = common_slope(figures.cycles, &CycleFigures::start);
  const double length = figures.cycles.back().start - figures.cycles.front().start;
  figures.drift = {figures.drift.value * length, figures.drift.error * length};
  const auto [coldest, hottest] =
      std::ranges::minmax(figures.cycles, {}, &CycleFigures::temperature);
  if (hottest.temperature - coldest.temperature >= kLeastTemperatureSpan)
    figures.fade = common_slope(figures.cycles, &CycleFigures::temperature);
  if (std::string remark = stick_slip_remark(c, figures.cycles); !remark.empty())
    figures.remarks.push_back(std::move(remark));
  return figures;
}

}  // namespace dashpot
