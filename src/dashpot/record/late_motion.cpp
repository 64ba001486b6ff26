#include "dashpot/record/late_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/numerics/non_negative.h"
#include "dashpot/record/inertia.h"

namespace dashpot {
namespace {

using Samples = std::vector<double>;

constexpr double kStep = 1e-3, kLongest = 0.02;  // s, of the delays that are tried
constexpr std::array kSlips = {0.0025, 0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32};  // of the stroke
constexpr std::array kKnees = {0.005, 0.02, 0.06, 0.2, 0.6};                        // of the speed

/// A record at a constant drive, and how it moves.
struct Moved {
  const Record* record = nullptr;
  const Samples* velocity = nullptr;
  Samples acceleration;
  double stroke = 0, speed = 0;  ///< m, m/s: from the middle, and the greatest that is usual
};

/// Nothing where the force's timing cannot be told: no constant drive, stamps that are uneven, or
/// hardly longer than the delays.
std::optional<Moved> moved(const Record& record) {
  constexpr double kFewest = 200, kShortest = 10 * kLongest;  // samples, s
  const Channel* velocity = record.find("velocity");
  const Channel* displacement = record.find("displacement");
  if (!record.drive_level || !velocity || !displacement || !record.find("force")) return {};
  const auto samples = static_cast<double>(record.size());
  if (samples < kFewest || !(samples * record.sample_time > kShortest)) return {};

  const auto [low, high] = std::ranges::minmax(displacement->samples);
  Moved one{&record, &velocity->samples, acceleration_of(record), 0.5 * (high - low),
            usual_acceleration(velocity->samples)};
  if (one.acceleration.empty() || !(one.stroke > 0) || !(one.speed > 0)) return {};
  return one;
}

/// Takes the least-squares line over the samples out of them: a zero that drifts.
void without_line(Samples& values) {
  const double middle = 0.5 * static_cast<double>(values.size() - 1);
  double mean = 0, slope = 0, weight = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double at = static_cast<double>(k) - middle;
    mean += values[k] / static_cast<double>(values.size());
    slope += at * values[k];
    weight += at * at;
  }
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] -= mean + slope / weight * (static_cast<double>(k) - middle);
}

double product_of(const Samples& a, const Samples& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// The samples of a record that count: some hundred, behind its beginning.
std::vector<std::size_t> counted_samples(const Record& record) {
  constexpr std::size_t kMost = 800, kBeginning = 8;  // an eighth
  const auto longest = static_cast<std::size_t>(std::ceil(kLongest / record.sample_time));
  const std::size_t first = std::max(record.size() / kBeginning, longest);
  const std::size_t step = std::max<std::size_t>(1, (record.size() - first) / kMost);
  std::vector<std::size_t> all;
  for (std::size_t k = first; k < record.size(); k += step) all.push_back(k);
  return all;
}

/// What a force may follow, one column each, at those samples.
std::vector<Samples> columns_of(const Moved& one, double stroke, double speed,
                                const std::vector<std::size_t>& at) {
  std::vector<Samples> columns;
  const Samples& v = *one.velocity;

  // Friction elements: each follows the motion up to its slip. The way they go is the velocity's,
  // which has less noise than the displacement.
  const double dt = one.record->sample_time;
  Samples way(v.size());
  for (std::size_t k = 1; k < v.size(); ++k) way[k] = 0.5 * dt * (v[k] + v[k - 1]);
  Samples place(v.size());
  std::partial_sum(way.begin(), way.end(), place.begin());
  const auto add = [&](const auto& value_of) {
    Samples& column = columns.emplace_back();
    for (const std::size_t k : at) column.push_back(value_of(k));
    without_line(column);
  };
  for (const double share : kSlips) {
    const double slip = share * stroke;
    Samples held(v.size());
    for (std::size_t k = 1; k < v.size(); ++k)
      held[k] = std::clamp(held[k - 1] + way[k], -slip, slip);
    add([&](std::size_t k) { return held[k] / slip; });
  }

  // Dampings, of rebound and compression apart, and a spring of either sign.
  for (const double side : {1.0, -1.0}) {
    const auto on_side = [&](std::size_t k) { return side * v[k] > 0 ? v[k] / speed : 0; };
    for (const double knee : kKnees)
      add([&](std::size_t k) { return std::tanh(on_side(k) / knee); });
    add(on_side);
    add([&](std::size_t k) { return side * place[k] / stroke; });
  }

  // An inertia.
  add([&](std::size_t k) { return one.acceleration[k]; });
  return columns;
}

/// The least-squares problem of the records at one drive, for each delay of the motion.
struct AtDrive {
  Samples matrix;
  std::vector<Samples> right;  ///< per delay
  Samples power;               ///< per delay: of the forces, each record's in its own

  void add(const Moved& one, double stroke, double speed, const Samples& delays) {
    const std::vector<std::size_t> at = counted_samples(*one.record);
    const std::vector<Samples> columns = columns_of(one, stroke, speed, at);
    const Samples& force = one.record->channel("force").samples;
    const std::size_t n = columns.size();
    matrix.resize(n * n);
    right.resize(delays.size(), Samples(n));
    power.resize(delays.size());

    double own = 0;
    for (std::size_t d = 0; d < delays.size(); ++d) {
      const auto back = static_cast<std::size_t>(std::lround(delays[d] / one.record->sample_time));
      Samples there;
      for (const std::size_t k : at) there.push_back(force[k - back]);
      without_line(there);
      if (d == 0) own = product_of(there, there);
      if (!(own > 0)) return;
      for (std::size_t i = 0; i < n; ++i) right[d][i] += product_of(columns[i], there) / own;
      power[d] += product_of(there, there) / own;
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        matrix[i * n + k] += product_of(columns[i], columns[k]) / own;
  }

  /// The share of the forces' power that is left at that delay.
  double left_at(std::size_t delay) const {
    const Samples x = solve_non_negative(matrix, right[delay]);
    return 1 - product_of(x, right[delay]) / power[delay];
  }
};

/// The records at each drive at which their motions differ enough to tell, in speed or frequency.
std::vector<std::vector<Moved>> unlike_motions(std::span<const Record> records) {
  std::map<double, std::vector<Moved>> by_drive;
  for (const Record& record : records)
    if (std::optional<Moved> one = moved(record))
      by_drive[*record.drive_level].push_back(std::move(*one));

  const auto differ = [](const std::vector<Moved>& here, const auto& size_of) {
    constexpr double kUnlike = 1.5;  // times
    const auto [least, most] = std::ranges::minmax(here, {}, size_of);
    return size_of(most) >= kUnlike * size_of(least);
  };
  std::vector<std::vector<Moved>> all;
  for (auto& [drive, here] : by_drive)
    if (differ(here, [](const Moved& one) { return one.speed; }) ||
        differ(here, [](const Moved& one) { return one.speed / one.stroke; }))
      all.push_back(std::move(here));
  return all;
}

}  // namespace

std::optional<Suspect> doubt_about_timing(std::span<const Record> records) {
  const std::vector<std::vector<Moved>> drives = unlike_motions(records);
  if (drives.empty()) return std::nullopt;

  // Delays in steps that every record has.
  double step = kStep;
  for (const std::vector<Moved>& here : drives)
    for (const Moved& one : here) step = std::max(step, one.record->sample_time);
  Samples delays;
  for (double delay = 0; delay <= kLongest; delay += step) delays.push_back(delay);

  // How much of the forces' power each delay leaves at each drive.
  std::vector<Samples> left;
  for (const std::vector<Moved>& here : drives) {
    const double stroke = std::ranges::max(here, {}, &Moved::stroke).stroke,
                 speed = std::ranges::max(here, {}, &Moved::speed).speed;
    AtDrive problem;
    for (const Moved& one : here) problem.add(one, stroke, speed, delays);
    Samples& shares = left.emplace_back();
    for (std::size_t d = 0; d < delays.size(); ++d) shares.push_back(problem.left_at(d));
  }

  // The delay that leaves the least, in what none leaves, tells if it does so at every drive.
  // Where none leaves next to nothing there is nothing to tell.
  constexpr double kTold = 0.6, kNothing = 1e-4;
  const auto mean_left = [&](std::size_t d) {
    double sum = 0;
    for (const Samples& shares : left) sum += shares[d] / std::max(shares[0], kNothing);
    return sum / static_cast<double>(left.size());
  };
  std::size_t best = 0;
  for (std::size_t d = 1; d < delays.size(); ++d)
    if (mean_left(d) < mean_left(best)) best = d;
  const auto is_told = [&](const Samples& shares) {
    return shares[0] > kNothing && shares[best] <= kTold * shares[0];
  };
  if (!std::ranges::all_of(left, is_told)) return std::nullopt;

  const Record& first = *drives.front().front().record;
  const double rows = std::round(delays[best] / first.sample_time);
  return Suspect{
      first.name,
      "the motion seems to be recorded some " + format_number(1e3 * delays[best]) +
          " ms later than the force, here and in the other records: the force goes ahead of it, "
          "which no damper's does. Were the motion earlier by that, friction, damping and inertia "
          "would leave " +
          format_number(mean_left(best), 2) +
          " times the squared error. Look at the delay of the displacement's electronics, and move "
          "its column up by that (here by " +
          format_number(rows) +
          " rows): models of these records are wrong where the motion is quicker"};
}

}  // namespace dashpot
