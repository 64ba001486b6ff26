#include "dashpot/record/characterise.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "dashpot/record/cycle_figures.h"

namespace dashpot {
namespace {

constexpr double kSameSpeed = 0.05;  // cycles within this share of speed are alike
constexpr double kSameStroke = 0.1;  // ... and of stroke
constexpr double kSameDrive = 0.02;  // of the greatest drive: levels within it are one
constexpr double kSteadyDrive =
    0.05;  // of the greatest drive: the most that it may vary in a cycle
constexpr std::size_t kSpeedsForCurve = 4;
constexpr double kSpreadForCurve = 3;     // greatest speed over the least
constexpr double kFrequencySpread = 1.5;  // greatest over least, to tell mass from gas
constexpr double kBeyond = 0.02;          // of a speed: how far outside the measured ones

/// A cycle that takes part in a level, and the record that it is of.
struct Member {
  const CycleFigures* cycle;
  std::size_t record;
  double speed() const { return (cycle->rebound.mid_speed + cycle->compression.mid_speed) / 2; }
};

Measured estimate_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, n > 1 ? std::sqrt(squares / (n - 1) / n) : kNoNumber};
}

/// Half of the sum, or of the difference, of two independent numbers.
Measured half_of(const Measured& a, const Measured& b, double sign) {
  return {(a.value + sign * b.value) / 2, std::hypot(a.error, b.error) / 2};
}

/// Means over alike cycles.
SpeedFigures figures_of_group(const std::vector<Member>& group) {
  SpeedFigures figures;
  figures.cycles = group.size();
  const auto mean = [&](auto value) {
    double sum = 0;
    for (const Member& member : group) sum += value(*member.cycle);
    return sum / static_cast<double>(group.size());
  };
  for (const auto& [to, from] : {std::pair{&SpeedFigures::rebound, &CycleFigures::rebound},
                                 {&SpeedFigures::compression, &CycleFigures::compression}})
    for (double StrokeFigures::* field : {&StrokeFigures::mid_speed, &StrokeFigures::mid_force,
                                          &StrokeFigures::peak_speed, &StrokeFigures::peak_force})
      (figures.*to).*field = mean([&](const CycleFigures& c) { return (c.*from).*field; });
  figures.speed = (figures.rebound.mid_speed + figures.compression.mid_speed) / 2;
  figures.damping_force = mean([](const CycleFigures& c) { return c.damping_force; });
  figures.hysteresis = mean([](const CycleFigures& c) { return c.hysteresis; });

  // The energy of a cycle grows with its stroke: it is told of alike strokes alone.
  const auto [least, most] =
      std::ranges::minmax(group, {}, [](const Member& member) { return member.cycle->stroke; });
  const bool alike = most.cycle->stroke <= (1 + kSameStroke) * least.cycle->stroke;
  figures.stroke = alike ? mean([](const CycleFigures& c) { return c.stroke; }) : kNoNumber;
  figures.energy = alike ? mean([](const CycleFigures& c) { return c.energy; }) : kNoNumber;
  figures.equivalent_damping = mean([](const CycleFigures& c) { return c.equivalent_damping; });
  return figures;
}

/// Scatter between cycles of one record and of like speed, %: pooled over the records.
double scatter_between_cycles(const std::vector<Member>& group) {
  double squares = 0, freedom = 0;
  for (std::size_t k = 0; k < group.size();) {
    std::size_t end = k;
    while (end < group.size() && group[end].record == group[k].record) ++end;
    double level = 0;
    for (std::size_t i = k; i < end; ++i)
      level += group[i].cycle->damping_force / static_cast<double>(end - k);
    for (std::size_t i = k; i < end; ++i)
      squares += std::pow(100 * (group[i].cycle->damping_force / level - 1), 2);
    freedom += static_cast<double>(end - k - 1);
    k = end;
  }
  return freedom > 0 ? std::sqrt(squares / freedom) : kNoNumber;
}

/// The members by ascending speed, in groups of like speed; each in the order of its records.
std::vector<SpeedFigures> speeds_of(std::vector<Member> members) {
  std::ranges::stable_sort(members, {}, &Member::speed);
  std::vector<std::vector<Member>> groups;
  for (const Member& member : members) {
    if (groups.empty() || member.speed() > groups.back().front().speed() * (1 + kSameSpeed))
      groups.emplace_back();
    groups.back().push_back(member);
  }
  std::vector<SpeedFigures> speeds;
  for (std::vector<Member>& group : groups) {
    std::ranges::stable_sort(group, {}, &Member::record);
    speeds.push_back(figures_of_group(group));
    speeds.back().repeatability = scatter_between_cycles(group);
  }
  return speeds;
}

/// The gas force's slope over the stroke. Moving mass and a lag of the force take from it and add
/// to it with the square of the frequency, so that a line over that square, where it varies, leads
/// to the slope at rest.
Measured rate_at_rest(const std::vector<Member>& members) {
  std::vector<double> rates, squares;
  for (const Member& member : members) {
    if (!std::isfinite(member.cycle->rate)) continue;
    rates.push_back(member.cycle->rate);
    squares.push_back(1 / (member.cycle->duration * member.cycle->duration));
  }
  if (rates.size() < 4) return estimate_of(rates);
  const auto [least, greatest] = std::ranges::minmax(squares);
  if (greatest < kFrequencySpread * kFrequencySpread * least) return estimate_of(rates);

  // Slower cycles count for more: the square is a first approximation only.
  double w = 0, wu = 0, wuu = 0, wy = 0, wuy = 0;
  const auto weight = [&](std::size_t k) { return least / squares[k]; };
  for (std::size_t k = 0; k < rates.size(); ++k) {
    w += weight(k);
    wu += weight(k) * squares[k];
    wuu += weight(k) * squares[k] * squares[k];
    wy += weight(k) * rates[k];
    wuy += weight(k) * squares[k] * rates[k];
  }
  const double determinant = w * wuu - wu * wu;
  const double value = (wuu * wy - wu * wuy) / determinant,
               slope = (w * wuy - wu * wy) / determinant;
  double left = 0;
  for (std::size_t k = 0; k < rates.size(); ++k)
    left += weight(k) * std::pow(rates[k] - value - slope * squares[k], 2);
  const double variance = left / static_cast<double>(rates.size() - 2);
  return {value, std::sqrt(variance * wuu / determinant)};
}

/// Forces of one direction over speed, and where what scatters together ends: behind the points of
/// each cycle of a loop or each record. Without such ends each point scatters by itself.
KneeFit knee_of(const MeanLoop& course) {
  return course.ends.empty() ? fit_knee(course.speed, course.force)
                             : fit_knee_of_parts(course.speed, course.force, course.ends);
}

/// Knee, friction and static force from the course of force over speed in both directions, which
/// may lead to v = 0 below a knee, or not. Where it does not, friction cannot be told, and the
/// static force comes from the lines above the knees.
void tell_from(LevelFigures& level, const MeanLoop& rebound, const MeanLoop& compression,
               bool leads_to_rest) {
  level.rebound = knee_of(rebound);
  level.compression = knee_of(compression);
  level.yield = half_of(level.rebound.yield, level.compression.yield, 1);
  const bool has_knee = level.rebound.knee.is_told() || level.compression.knee.is_told();
  if (leads_to_rest || !has_knee) {
    level.friction = half_of(level.rebound.at_rest, level.compression.at_rest, 1);
    level.static_force = half_of(level.compression.at_rest, level.rebound.at_rest, -1);
  }
  if (!level.friction.is_told())
    level.static_force = half_of(level.compression.yield, level.rebound.yield, -1);
}

/// Mid-stroke forces over speed of one direction (`sign`: 1 for the rebound, -1 for the
/// compression), record by record: those of one record share its zero. A single record has no
/// parts.
MeanLoop mid_stroke_forces(const std::vector<Member>& by_record, StrokeFigures CycleFigures::* way,
                           double sign) {
  MeanLoop course;
  for (const Member& member : by_record) {
    course.speed.push_back((member.cycle->*way).mid_speed);
    course.force.push_back(sign * (member.cycle->*way).mid_force);
  }
  for (std::size_t k = 1; k < by_record.size(); ++k)
    if (by_record[k].record != by_record[k - 1].record) course.ends.push_back(k);
  if (!course.ends.empty()) course.ends.push_back(by_record.size());
  return course;
}

LevelFigures figures_of_level(const std::vector<Member>& members, const Dataset& dataset) {
  LevelFigures level;
  level.speeds = speeds_of(members);
  level.rate = rate_at_rest(members);

  // Mid-stroke forces at several speeds are free of hysteresis and inertia: they come first.
  const double slowest = level.speeds.front().speed, fastest = level.speeds.back().speed;
  if (level.speeds.size() >= kSpeedsForCurve && fastest >= kSpreadForCurve * slowest) {
    level.basis = "speeds";
    std::vector<Member> by_record = members;
    std::ranges::stable_sort(by_record, {}, &Member::record);
    tell_from(level, mid_stroke_forces(by_record, &CycleFigures::rebound, 1),
              mid_stroke_forces(by_record, &CycleFigures::compression, -1), true);
    return level;
  }

  // Else the loops of the record with the fastest cycle, where its cycles are alike.
  level.basis = "loop";
  const std::size_t chosen = std::ranges::max_element(members, {}, &Member::speed)->record;
  std::vector<double> integrated;
  const DynoChannels channels =
      dyno_channels(dataset.records[chosen], dataset.drive_unit, integrated);
  MeanLoop rebound, compression;
  for (const Member& member : members) {
    if (member.record != chosen || member.speed() < fastest / (1 + 2 * kSameSpeed)) continue;
    add_mean_loop(channels, *member.cycle, 1, rebound);
    add_mean_loop(channels, *member.cycle, -1, compression);
  }
  // Below the knee of a loop the force still builds up after the reversal, and leads nowhere.
  tell_from(level, rebound, compression, false);
  return level;
}

/// Groups of members of like drive, ascending.
std::vector<std::vector<Member>> by_level(std::vector<Member> members, double greatest) {
  std::ranges::stable_sort(members, {}, [](const Member& m) { return m.cycle->drive; });
  std::vector<std::vector<Member>> levels;
  for (const Member& member : members) {
    if (levels.empty() ||
        member.cycle->drive > levels.back().front().cycle->drive + kSameDrive * greatest)
      levels.emplace_back();
    levels.back().push_back(member);
  }
  return levels;
}

/// Whether the drive holds still within a cycle, its spikes at switching apart.
bool is_steady(const Record& record, const CycleFigures& cycle, DriveUnit unit, double greatest) {
  if (record.drive_level || unit == DriveUnit::None) return true;
  const Channel* drive = record.find(drive_channel(unit));
  if (!drive) return false;
  std::vector<double> samples(drive->samples.begin() + static_cast<std::ptrdiff_t>(cycle.first),
                              drive->samples.begin() + static_cast<std::ptrdiff_t>(cycle.last));
  std::ranges::sort(samples);
  const std::size_t margin = samples.size() / 50;
  return samples[samples.size() - 1 - margin] - samples[margin] <= kSteadyDrive * greatest;
}

/// What of a level to beware of.
std::vector<std::string> remarks_of(const LevelFigures& level) {
  std::vector<std::string> remarks;
  if (level.basis == "loop")
    remarks.push_back(
        fmt::format("no slow cycles: knee and yield force come from the loops of the fastest ones "
                    "and hold their hysteresis and inertia, and friction cannot be told apart from "
                    "the field force; run {} or more speeds, the fastest {} times the slowest",
                    kSpeedsForCurve, kSpreadForCurve));
  for (const auto& [direction, fit] :
       {std::pair{"rebound", &level.rebound}, {"compression", &level.compression}})
    if (fit->is_knee_beyond_speeds)
      remarks.push_back(fmt::format("no knee of the {}: {}", direction, fit->why_no_knee));
  if (level.friction.is_told() && level.friction.error > 0.1 * std::abs(level.friction.value))
    remarks.push_back("the friction is told to no better than 10 %: record slower cycles");
  if (level.yield.is_told() && !std::isfinite(level.yield.error))
    remarks.push_back(
        "the errors of knee and yield force are not known: without one of the cycles or records "
        "there is another curve, or none; repeat cycles, record more speeds");
  return remarks;
}

/// The force at the highest over that at the lowest drive.
std::vector<DynamicRange> dynamic_range(const Characterisation& all,
                                        const std::vector<double>& stated) {
  if (all.levels.size() < 2) return {};
  const LevelFigures &low = all.levels.front(), &high = all.levels.back();
  std::vector<double> speeds = stated;
  if (speeds.empty())
    for (const SpeedFigures& s : low.speeds) speeds.push_back(s.speed);
  std::vector<DynamicRange> ranges;
  for (const double speed : speeds) {
    const auto below = at_speed(low, speed), above = at_speed(high, speed);
    if (below && above)
      ranges.push_back({speed, above->damping_force / below->damping_force, below->damping_force,
                        above->damping_force});
  }
  return ranges;
}

}  // namespace

std::optional<SpeedFigures> at_speed(const LevelFigures& level, double speed) {
  const auto& speeds = level.speeds;
  if (speeds.empty() || speed < speeds.front().speed * (1 - kBeyond) ||
      speed > speeds.back().speed * (1 + kBeyond))
    return std::nullopt;
  const auto above = std::ranges::lower_bound(speeds, speed, {}, &SpeedFigures::speed);
  if (above == speeds.begin()) return speeds.front();
  if (above == speeds.end()) return speeds.back();

  // On the straight line between its neighbours; what is no force is that of the nearer one.
  const SpeedFigures &a = above[-1], &b = *above;
  const double share = (speed - a.speed) / (b.speed - a.speed);
  SpeedFigures between = share < 0.5 ? a : b;
  const auto mix = [&](double from, double to) { return from + share * (to - from); };
  for (StrokeFigures SpeedFigures::* side : {&SpeedFigures::rebound, &SpeedFigures::compression})
    for (double StrokeFigures::* field : {&StrokeFigures::mid_speed, &StrokeFigures::mid_force,
                                          &StrokeFigures::peak_speed, &StrokeFigures::peak_force})
      (between.*side).*field = mix((a.*side).*field, (b.*side).*field);
  for (double SpeedFigures::* field : {&SpeedFigures::damping_force, &SpeedFigures::hysteresis,
                                       &SpeedFigures::energy, &SpeedFigures::equivalent_damping})
    between.*field = mix(a.*field, b.*field);
  if (!(std::abs(a.stroke - b.stroke) <= kSameStroke * std::min(a.stroke, b.stroke)))
    between.stroke = between.energy = kNoNumber;
  between.speed = speed;
  return between;
}

Characterisation characterise(const Dataset& dataset, const CharacteriseOptions& options) {
  Characterisation all;
  all.drive_unit = dataset.drive_unit;
  all.stated_speeds = options.speeds;
  for (const Record& record : dataset.records)
    all.records.push_back(figures_of_record(record, dataset.drive_unit));

  // A stated level is the drive, whatever noise a channel of it has.
  double greatest = 0;
  for (RecordFigures& record : all.records)
    for (CycleFigures& cycle : record.cycles) {
      if (record.drive_level && dataset.drive_unit != DriveUnit::None)
        cycle.drive = *record.drive_level;
      if (std::isfinite(cycle.drive)) greatest = std::max(greatest, std::abs(cycle.drive));
    }

  // Cycles whose drive holds still are judged together, level by level.
  std::vector<Member> known, unknown;
  for (std::size_t r = 0; r < all.records.size(); ++r) {
    std::size_t unsteady = 0;
    for (const CycleFigures& cycle : all.records[r].cycles) {
      if (!is_steady(dataset.records[r], cycle, dataset.drive_unit, greatest)) {
        ++unsteady;
        continue;
      }
      (std::isfinite(cycle.drive) ? known : unknown).push_back({&cycle, r});
    }
    if (unsteady > 0)
      all.records[r].remarks.push_back(fmt::format(
          "the drive changes within {} of {} cycles: they are no part of a family over it",
          unsteady, all.records[r].cycles.size()));
  }
  std::vector<std::vector<Member>> levels = by_level(std::move(known), greatest);
  if (!unknown.empty()) levels.push_back(std::move(unknown));
  for (const std::vector<Member>& members : levels) {
    LevelFigures level = figures_of_level(members, dataset);
    if (std::isfinite(members.front().cycle->drive)) level.drive = members.front().cycle->drive;
    level.remarks = remarks_of(level);
    all.levels.push_back(std::move(level));
  }
  if (dataset.drive_unit != DriveUnit::None) all.range = dynamic_range(all, options.speeds);
  if (all.levels.empty())
    all.remarks.push_back("no cycles at a steady drive: no figures of the damper can be told");
  return all;
}

}  // namespace dashpot
