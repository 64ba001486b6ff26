#include "dashpot/record/doubts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/numerics/median.h"
#include "dashpot/numerics/root_mean_square.h"
#include "dashpot/record/side_passes.h"
#include "dashpot/record/time_base.h"
#include "dashpot/record/unit_doubts.h"

namespace dashpot {
namespace {

using Samples = std::vector<double>;

/// Samples first ... end - 1.
struct Run {
  std::size_t first = 0, end = 0;
  std::size_t count() const { return end - first; }
};

/// Visits the runs of equal values, of which most records have one per sample.
template <typename Visit>
void visit_equal_runs(const Samples& values, const Visit& visit) {
  for (Run run; run.first < values.size(); run.first = run.end) {
    run.end = run.first + 1;
    while (run.end < values.size() && values[run.end] == values[run.first]) ++run.end;
    visit(run);
  }
}

/// The runs of equal values that hold at least `least` samples.
std::vector<Run> equal_runs(const Samples& values, std::size_t least) {
  std::vector<Run> runs;
  visit_equal_runs(values, [&](const Run& run) {
    if (run.count() >= least) runs.push_back(run);
  });
  return runs;
}

/// The span between the first and the last percent of the values.
double usual_span(Samples values) {
  const auto place = [&](double share) {
    return static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  };
  const auto value_at = [&](double share, Samples::iterator from) {
    const auto at = values.begin() + place(share);
    std::nth_element(from, at, values.end());
    return *at;
  };
  constexpr double kLow = 0.01, kHigh = 0.99;
  const double low = value_at(kLow, values.begin());
  // What is larger stands behind it now.
  return value_at(kHigh, values.begin() + place(kLow)) - low;
}

/// How far the values go from sample to sample.
Samples steps_of(const Samples& values) {
  Samples steps(values.size() - 1);
  for (std::size_t k = 1; k < values.size(); ++k)
    steps[k - 1] = std::abs(values[k] - values[k - 1]);
  return steps;
}

std::string seconds(double time) { return format_number(time, 5) + " s"; }

std::string between(const Record& record, const Run& run) {
  return "from " + seconds(record.time[run.first]) + " to " + seconds(record.time[run.end - 1]);
}

/// How far the damper goes within a run, as a share of the stroke.
double way_within(const Samples& displacement, const Run& run, double stroke) {
  double way = 0;
  for (std::size_t k = run.first + 1; k < run.end; ++k)
    way += std::abs(displacement[k] - displacement[k - 1]);
  return way / stroke;
}

/// Whether the values lie on so few steps of their resolution that friction alone may stand on one
/// of them throughout a stroke.
bool is_coarse(const Samples& values) {
  constexpr double kSteps = 64;
  double least = std::numeric_limits<double>::infinity();
  for (const double step : steps_of(values))
    if (step > 0) least = std::min(least, step);
  return std::isfinite(least) && usual_span(values) < kSteps * least;
}

/// Whether the damper turns within a run: it goes further than from its beginning to its end.
bool turns_within(const Samples& displacement, const Run& run, double stroke) {
  constexpr double kBack = 0.05;
  const double net = std::abs(displacement[run.end - 1] - displacement[run.first]) / stroke;
  return way_within(displacement, run, stroke) - net > kBack;
}

/// A force that does not change at all while the damper goes on. Where its resolution is coarse the
/// damper must turn meanwhile, which friction does not outlast.
std::optional<std::string> stuck_force(const Record& record, const Samples& force,
                                       const Samples& displacement, double stroke) {
  constexpr std::size_t kLeast = 10;
  constexpr double kShareOfStroke = 0.4;
  Run worst;
  double longest = kShareOfStroke;
  for (const Run& run : equal_runs(force, kLeast))
    if (const double way = way_within(displacement, run, stroke);
        way > longest && (turns_within(displacement, run, stroke) || !is_coarse(force))) {
      longest = way;
      worst = run;
    }
  if (worst.count() == 0) return std::nullopt;
  return "the force stands at " + format_number(force[worst.first], 6) + " N " +
         between(record, worst) + " while the damper moves: the sensor stuck, or was not recorded";
}

/// A displacement that stands still and then leaps by more than any of its other steps.
std::optional<std::string> stuck_displacement(const Record& record, const Samples& displacement) {
  constexpr std::size_t kLeast = 5;
  constexpr double kLeap = 3, kUsual = 0.95;

  const std::vector<Run> stops = equal_runs(displacement, kLeast);
  if (stops.empty()) return std::nullopt;

  // How far it usually goes at most from sample to sample.
  Samples steps = steps_of(displacement);
  const auto usual =
      steps.begin() + static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(steps.size() - 1));
  std::nth_element(steps.begin(), usual, steps.end());

  // A leap behind a stop is far above that.
  for (const Run& run : stops)
    if (run.end < displacement.size() && *usual > 0 &&
        std::abs(displacement[run.end] - displacement[run.end - 1]) > kLeap * *usual)
      return "the displacement stands still " + between(record, run) +
             " and leaps then: the sensor stuck, or samples were lost";
  return std::nullopt;
}

/// Whether values go smoothly from sample to sample, as a motion does and noise does not.
bool is_smooth(const Samples& values) {
  constexpr double kShare = 0.05;  // of the span, in the median
  const auto [low, high] = std::ranges::minmax(values);
  return median(steps_of(values)) < kShare * (high - low);
}

/// A displacement that stands still while force or a measured velocity go to and fro.
std::optional<std::string> dead_displacement(const Record& record, const Samples& displacement) {
  constexpr std::size_t kLeast = 20, kPasses = 3;
  constexpr double kBand = 0.2;
  for (const Run& still : equal_runs(displacement, kLeast)) {
    const bool from_start = still.first == 0, to_end = still.end == displacement.size();

    // A motion that ends at rest lets the force settle; a motion that goes on takes it from one
    // half of its usual range into the other, and back. Where nothing ever moves, noise does so.
    for (const std::string_view name : {"force", "velocity"}) {
      const Channel* channel = record.find(name);
      if (!channel || channel->origin.starts_with("derived")) continue;
      if (from_start && to_end && !is_smooth(channel->samples)) continue;
      const auto [low, high] = std::ranges::minmax(channel->samples);
      SidePasses passes{0.5 * (low + high), kBand * 0.5 * (high - low)};
      for (std::size_t k = still.first; k < still.end; ++k) passes.see(channel->samples[k]);
      if (passes.count < kPasses) continue;

      const std::string goes_on = " while the " + std::string(name) + " goes on: ";
      if (from_start && to_end)
        return "the displacement stands still throughout" + goes_on +
               "the sensor is dead, or the column another one";
      return "the displacement stands still " + between(record, still) +
             (to_end       ? ", the end of the record,"
              : from_start ? ", the start of the record,"
                           : "") +
             goes_on + "the sensor " + (to_end ? "died" : "stuck") +
             (to_end || from_start ? "; 'cut' in a dataset file leaves that part out" : "");
    }
  }
  return std::nullopt;
}

/// A measured velocity that does not change at all while the displacement goes elsewhere.
std::optional<std::string> stuck_velocity(const Record& record, const Samples& displacement) {
  constexpr std::size_t kLeast = 20;
  constexpr double kShareOfStroke = 0.2;
  const Channel* velocity = record.find("velocity");
  if (!velocity || velocity->origin.starts_with("derived")) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(displacement);
  for (const Run& run : equal_runs(velocity->samples, kLeast)) {
    const double v = velocity->samples[run.first];

    // How far it is from where that velocity would have it: after whole cycles it is back.
    double least = 0, most = 0;
    for (std::size_t k = run.first; k < run.end; ++k) {
      const double way = v * (record.time[k] - record.time[run.first]);
      const double elsewhere = displacement[k] - displacement[run.first] - way;
      least = std::min(least, elsewhere);
      most = std::max(most, elsewhere);
    }
    if (most - least > kShareOfStroke * (high - low))
      return "the velocity stands at " + format_number(v, 6) + " m/s " + between(record, run) +
             " while the displacement goes up to " + format_number(most - least, 3) +
             " m elsewhere: the sensor stuck, or its range was too small";
  }
  return std::nullopt;
}

/// One extreme value in several samples, far from all others: what loggers write where they have
/// no value, -9999 or the end of a converter's range.
std::optional<std::string> placeholder(const Record& record, const Channel& channel) {
  constexpr double kFar = 3, kMostOften = 0.2;
  const Samples& values = channel.samples;
  const auto [lowest, highest] = std::ranges::minmax(values);
  for (const double extreme : {lowest, highest}) {
    // All others, and how often it is there itself.
    double low = INFINITY, high = -INFINITY;
    std::size_t count = 0, first = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (values[k] == extreme) {
        if (count++ == 0) first = k;
        continue;
      }
      low = std::min(low, values[k]), high = std::max(high, values[k]);
    }

    const double gap = extreme < low ? low - extreme : extreme - high;
    if (count < 2 || static_cast<double>(count) > kMostOften * static_cast<double>(values.size()))
      continue;
    if (!(high > low) || gap <= kFar * (high - low)) continue;
    return "the " + channel.name + " is " + format_number(extreme, 6) + " " + channel.unit +
           " in " + std::to_string(count) + " samples, the first at " +
           seconds(record.time[first]) +
           ", far from all others, as loggers write where they have no value: leave these cells "
           "empty, and their rows out by 'on_bad_row: drop' in a dataset file";
  }
  return std::nullopt;
}

/// An extreme at which the force stays, sample for sample, whenever it gets there, and which it
/// reaches by a step far above its resolution.
std::optional<std::string> clipped_force(const Samples& force, const Samples& displacement,
                                         double stroke) {
  constexpr std::size_t kLeast = 4, kRuns = 2;
  constexpr double kEntry = 5, kMoving = 0.002;
  double resolution = INFINITY;
  for (std::size_t k = 1; k < force.size(); ++k)
    if (const double step = std::abs(force[k] - force[k - 1]); step > 0)
      resolution = std::min(resolution, step);

  const auto [lowest, highest] = std::ranges::minmax(force);
  for (const double limit : {highest, lowest}) {
    std::size_t runs = 0, samples = 0;
    for (const Run& run : equal_runs(force, kLeast)) {
      if (force[run.first] != limit || run.first == 0) continue;
      if (std::abs(force[run.first - 1] - limit) < kEntry * resolution) continue;
      if (way_within(displacement, run, stroke) < kMoving) continue;
      ++runs;
      samples += run.count();
    }
    if (runs >= kRuns)
      return "the force is clipped at " + format_number(limit, 6) + " N, in " +
             std::to_string(samples) + " samples of " + std::to_string(runs) +
             " peaks: the range of the sensor or of its amplifier was too small";
  }
  return std::nullopt;
}

/// Single samples that stand out from two neighbours that agree.
std::optional<std::string> spikes(const Record& record, const Samples& values, double span,
                                  std::string_view name) {
  constexpr double kHeight = 0.3, kAgree = 0.25, kMostOften = 0.01;

  // High above both neighbours, or far below, which differ little from one another.
  std::size_t count = 0, first = 0;
  for (std::size_t k = 1; k + 1 < values.size(); ++k) {
    const double before = values[k] - values[k - 1], after = values[k] - values[k + 1];
    const double height = std::min(std::abs(before), std::abs(after));
    if (before * after <= 0 || height < kHeight * span) continue;
    if (std::abs(values[k - 1] - values[k + 1]) > kAgree * height) continue;
    if (count++ == 0) first = k;
  }

  // What is frequent is noise.
  if (count == 0 || static_cast<double>(count) > kMostOften * static_cast<double>(values.size()))
    return std::nullopt;
  return "the " + std::string(name) + " has " +
         (count == 1 ? "a spike of one sample at "
                     : std::to_string(count) + " spikes of one sample, the first at ") +
         seconds(record.time[first]);
}

/// A channel that was sampled more slowly than the record and held in between: runs of equal values
/// of one length, and steps between them far above the resolution. A slow motion before a coarse
/// sensor stands as long, but goes on by one step of its resolution.
std::optional<std::string> held(const Record& record, const Samples& values,
                                std::string_view name) {
  constexpr std::size_t kFewest = 10, kRest = 3;
  constexpr double kAlike = 0.8, kAbove = 3;

  // Where most samples differ from the one before it, nothing is held.
  std::size_t runs = 0, single = 0;
  visit_equal_runs(values, [&](const Run& run) {
    if (run.end == values.size()) return;
    ++runs;
    single += run.count() == 1;
  });
  if (single > runs / 2) return std::nullopt;

  // How long it stands each time but the last, and how far it goes then.
  std::vector<std::size_t> lengths;
  Samples steps;
  Run before;
  visit_equal_runs(values, [&](const Run& run) {
    if (run.first > 0) {
      lengths.push_back(before.count());
      steps.push_back(std::abs(values[run.first] - values[before.first]));
    }
    before = run;
  });
  if (lengths.size() + 1 < kFewest) return std::nullopt;

  // The medians.
  const auto middle = static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::ranges::nth_element(lengths, lengths.begin() + middle);
  std::ranges::nth_element(steps, steps.begin() + middle);
  const std::size_t length = lengths[static_cast<std::size_t>(middle)];
  const double resolution = std::ranges::min(steps);
  if (length < 2 || steps[static_cast<std::size_t>(middle)] < kAbove * resolution)
    return std::nullopt;

  // Nearly all stand as long, give or take a sample; what stands much longer is at rest.
  const std::size_t least = std::max<std::size_t>(length - 1, 2);
  std::size_t alike = 0, moving = 0, samples = 0;
  for (const std::size_t one : lengths) {
    moving += one <= kRest * length;
    if (one < least || one > length + 1) continue;
    ++alike;
    samples += one;
  }
  if (static_cast<double>(alike) < kAlike * static_cast<double>(moving)) return std::nullopt;

  const double each = static_cast<double>(samples) / static_cast<double>(alike),
               span = record.time.back() - record.time.front(),
               rate = static_cast<double>(record.size() - 1) / (each * span);
  return "the " + std::string(name) + " stands for " + format_number(each, 3) +
         " samples at a time: it was sampled at " + format_number(rate, 3) +
         " Hz and held, which bends the loops; 'resample: " + format_number(rate, 3) +
         "' in a dataset file brings all channels to that rate";
}

/// A first or last step far above all others, as where a line of ranges was taken for a sample, or
/// where the digits of a last number are missing.
std::optional<std::string> leap_at_an_end(const Samples& values, std::string_view name) {
  constexpr double kLeap = 10;
  const auto step_to = [&](std::size_t k) { return std::abs(values[k] - values[k - 1]); };
  const std::size_t last = values.size() - 1;
  double largest = 0;
  for (std::size_t k = 2; k < last; ++k) largest = std::max(largest, step_to(k));
  if (largest == 0) return std::nullopt;
  if (step_to(last) > kLeap * largest)
    return "the " + std::string(name) + " leaps at the last sample: the file may have been cut off";
  if (step_to(1) > kLeap * largest)
    return "the " + std::string(name) +
           " leaps behind the first sample, which may be none: 'cut' in a dataset file leaves it "
           "out";
  return std::nullopt;
}

/// The correlation of a measured velocity with the slope of the displacement that many samples
/// before.
double velocity_with_slope(const Samples& velocity, const Samples& slope, std::ptrdiff_t later) {
  double vv = 0, ss = 0, vs = 0;
  const auto size = static_cast<std::ptrdiff_t>(slope.size());
  for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, -later); k < size && k + later < size; ++k) {
    const double v = velocity[static_cast<std::size_t>(k + later)],
                 s = slope[static_cast<std::size_t>(k)];
    vv += v * v;
    ss += s * s;
    vs += v * s;
  }
  return vv > 0 && ss > 0 ? vs / std::sqrt(vv * ss) : 0;
}

/// A measured velocity that comes later than the displacement goes, or earlier: by steps of half a
/// millisecond and more, up to 20 ms.
std::optional<std::string> late_velocity(const Record& record, const Samples& velocity,
                                         const Samples& slope) {
  constexpr double kStep = 0.5e-3, kLeast = 2e-3, kMost = 20e-3;  // s
  constexpr double kSame = 0.98, kLess = 0.25;  // correlation, of the difference's square
  if (!(record.sample_time > 0)) return std::nullopt;

  // The shift with which both are most alike.
  const auto step = static_cast<std::ptrdiff_t>(std::max(1.0, kStep / record.sample_time));
  const auto most = static_cast<std::ptrdiff_t>(kMost / record.sample_time);
  const double at_once = velocity_with_slope(velocity, slope, 0);
  double alike = at_once;
  std::ptrdiff_t later = 0;
  for (std::ptrdiff_t shift = step; shift <= most; shift += step)
    for (const std::ptrdiff_t either : {shift, -shift})
      if (const double here = velocity_with_slope(velocity, slope, either); here > alike) {
        alike = here;
        later = either;
      }

  const double delay = static_cast<double>(later) * record.sample_time;
  if (std::abs(delay) < kLeast || alike < kSame || 1 - alike > kLess * (1 - at_once))
    return std::nullopt;
  return "the velocity comes " + format_number(1e3 * std::abs(delay), 3) + " ms " +
         (delay > 0 ? "later" : "earlier") +
         " than the displacement goes: one of the two stands behind a filter; 'channels' in a "
         "dataset file without the late one leaves it out, and it follows from the other";
}

/// Where a measured velocity takes the damper, its mean apart, m.
Samples travel_of(const Record& record, const Channel& velocity) {
  const double mean = std::accumulate(velocity.samples.begin(), velocity.samples.end(), 0.0) /
                      static_cast<double>(velocity.samples.size());
  Samples travel(velocity.samples.size());
  for (std::size_t k = 1; k < travel.size(); ++k)
    travel[k] =
        travel[k - 1] + (velocity.samples[k] - mean) * (record.time[k] - record.time[k - 1]);
  return travel;
}

/// A measured velocity that is not the displacement's: by its sign, its size or its time.
std::optional<std::string> unlike_velocity(const Record& record, const Samples& displacement) {
  constexpr double kAlike = 0.9, kAgainst = -0.5, kMost = 3;
  const Channel* const velocity = record.find("velocity");
  if (!velocity || velocity->origin.starts_with("derived")) return std::nullopt;

  Samples slope(displacement.size());
  for (std::size_t k = 1; k + 1 < displacement.size(); ++k)
    slope[k] =
        (displacement[k + 1] - displacement[k - 1]) / (record.time[k + 1] - record.time[k - 1]);
  slope.front() = slope[1];
  slope.back() = slope[slope.size() - 2];

  const double alike = velocity_with_slope(velocity->samples, slope, 0);
  if (alike < kAgainst)
    return "displacement falls where velocity is positive: one of the two has the other sign; "
           "state 'sign: -1' for it in a dataset file";
  const double ratio = root_mean_square(velocity->samples) / root_mean_square(slope);
  if (alike >= kAlike && (ratio >= kMost || ratio <= 1 / kMost))
    return "the velocity is " + format_number(ratio, 3) +
           " times that of the displacement: the unit of one of them may be wrong";

  // The slope of a noisy displacement may be noise: what the velocity comes to is beyond that.
  const double travel = usual_span(travel_of(record, *velocity));
  if (alike < kAlike && travel > 0 && usual_span(displacement) >= kMost * travel)
    return "the displacement goes " + format_number(usual_span(displacement) / travel, 3) +
           " times as far as the velocity would take it: one of the two may be another column";
  return late_velocity(record, velocity->samples, slope);
}

/// Spikes are told of where no placeholder is taken for one.
std::optional<std::string> spikes_or_placeholder(const Record& record, const Channel& channel) {
  if (auto missing = placeholder(record, channel)) return missing;
  const double span = usual_span(channel.samples);
  return span > 0 ? spikes(record, channel.samples, span, channel.name) : std::nullopt;
}

/// Where the stamps tell that samples are missing and nothing was resampled.
std::optional<std::string> lost(const Record& record) {
  if (record.sample_time > 0) return std::nullopt;
  const LostSamples lost = lost_samples(record.time);
  if (lost.places == 0) return std::nullopt;
  return describe(lost) +
         ": the logger lost them; 'resample' in a dataset file fills them with straight lines";
}

/// A clipped force stands still, too.
std::optional<std::string> clipped_or_stuck_force(const Record& record, const Samples& force,
                                                  const Samples& displacement) {
  const auto [low, high] = std::ranges::minmax(displacement);
  if (high <= low) return std::nullopt;
  const auto clipped = clipped_force(force, displacement, high - low);
  return clipped ? clipped : stuck_force(record, force, displacement, high - low);
}

/// The value below which that share of them lies; they are put into another order.
double quantile(Samples& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

/// Whether a force grows with the speed and still takes no energy out of the motion: that of an
/// ideal yield, which leaps over zero, without its sign. Gas and springs keep the energy that
/// friction and fluid take, and a force that nothing moves does not grow.
bool rises_both_ways(const Samples& force, const Samples& displacement) {
  constexpr double kMiddle = 0.5, kEnds = 0.9;  // of half of the stroke
  constexpr double kStrokes = 4, kTaken = 0.05, kRise = 0.3;
  const auto [least, most] = std::ranges::minmax(force);
  const auto [low, high] = std::ranges::minmax(displacement);
  const double span = most - least, size_of_least = std::min(std::abs(least), std::abs(most));

  double way = 0, taken = 0;
  std::array<Samples, 3> sizes;  // at the one end, in the middle, at the other end
  for (std::size_t k = 1; k < force.size(); ++k) {
    const double step = displacement[k] - displacement[k - 1];
    way += std::abs(step);
    taken += (0.5 * (force[k] + force[k - 1]) - 0.5 * (least + most)) * step;
    const double place = (displacement[k] + displacement[k - 1] - low - high) / (high - low);
    if (std::abs(place) < kMiddle || std::abs(place) > kEnds)
      sizes[std::abs(place) < kMiddle ? 1 : place < 0 ? 0 : 2].push_back(std::abs(force[k]));
  }
  if (way < kStrokes * (high - low) || std::abs(taken) > kTaken * span * way) return false;
  if (std::ranges::any_of(sizes, &Samples::empty)) return false;

  // Far above the least at the speeds of the middle, both ways, and near it at both ends.
  constexpr double kWeakest = 0.1, kUsual = 0.5;
  const double slow = std::max(quantile(sizes[0], kUsual), quantile(sizes[2], kUsual));
  return quantile(sizes[1], kWeakest) > slow + kRise * span && slow > size_of_least;
}

/// A force without its direction: it is of one sign and falls at either end of the stroke far below
/// what it is in its middle both ways, or grows both ways. A gas force that keeps the sign has its
/// least in the middle, against compression, and a spring at one of the ends.
std::optional<std::string> unsigned_force(const Samples& force, const Samples& displacement) {
  constexpr double kMiddle = 0.5, kEnds = 0.6;  // of half of the stroke
  constexpr double kFar = 0.3, kWeakest = 0.1;
  const auto [least, most] = std::ranges::minmax(force);
  const auto [low, high] = std::ranges::minmax(displacement);
  if (least * most < 0 || least == most || low == high) return std::nullopt;

  // How far along the stroke each sample is: -1 and 1 at its ends.
  Samples middle;
  double below = std::numeric_limits<double>::infinity(), above = below;
  for (std::size_t k = 0; k < force.size(); ++k) {
    const double place = (2 * displacement[k] - low - high) / (high - low);
    const double size = std::abs(force[k]);
    if (std::abs(place) < kMiddle) middle.push_back(size);
    if (place < -kEnds) below = std::min(below, size);
    if (place > kEnds) above = std::min(above, size);
  }
  const bool falls_far =
      !middle.empty() && std::max(below, above) < kFar * quantile(middle, kWeakest);
  if (!falls_far && !rises_both_ways(force, displacement)) return std::nullopt;
  return "the force has one sign whichever way the damper goes, and is least at both ends of the "
         "stroke: it seems to be a size that has lost its direction; record or export it with its "
         "sign";
}

}  // namespace

std::vector<std::string> doubts_about(const Record& record) {
  std::vector<std::string> doubts = doubts_about_units(record);
  constexpr std::size_t kFewest = 20;     // samples that tell a pattern
  constexpr std::size_t kMany = 100'000;  // from which threads pay
  if (record.size() < kFewest) return doubts;
  std::vector<std::function<std::optional<std::string>()>> checks;

  // What the channels show by themselves.
  const Channel* const force = record.find("force");
  const Channel* const displacement = record.find("displacement");
  for (const Channel* channel : {displacement, force})
    if (channel) {
      checks.emplace_back([&record, channel] { return spikes_or_placeholder(record, *channel); });
      checks.emplace_back([channel] { return leap_at_an_end(channel->samples, channel->name); });
    }
  for (const std::string_view name : {"displacement", "velocity", "force"})
    if (const Channel* channel = record.find(name))
      checks.emplace_back(
          [&record, channel] { return held(record, channel->samples, channel->name); });

  // What a logger lost, and what the motion makes implausible.
  checks.emplace_back([&record] { return lost(record); });
  if (displacement) {
    const Samples& x = displacement->samples;
    checks.emplace_back([&] {
      const auto stuck = stuck_displacement(record, x);
      return stuck ? stuck : dead_displacement(record, x);
    });
    checks.emplace_back([&] { return stuck_velocity(record, x); });
    checks.emplace_back([&] { return unlike_velocity(record, x); });
    if (force) checks.emplace_back([&] { return unsigned_force(force->samples, x); });
    if (force)
      checks.emplace_back([&] { return clipped_or_stuck_force(record, force->samples, x); });
  }

  // Beside each other where there is much to look at; told in this order.
  std::vector<std::optional<std::string>> found(checks.size());
  parallel_for(checks.size(), record.size() < kMany ? 1 : 0,
               [&](std::size_t k) { found[k] = checks[k](); });
  for (std::optional<std::string>& doubt : found)
    if (doubt) doubts.push_back(std::move(*doubt));
  return doubts;
}

}  // namespace dashpot
