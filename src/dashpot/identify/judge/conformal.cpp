#include "dashpot/identify/judge/conformal.h"

#include <algorithm>
#include <cmath>

namespace dashpot {
namespace {

/// Of the largest |v|: the ends of pre-yield, low and middle speeds.
constexpr double kSpeedShares[] = {0.05, 0.25, 0.6};
constexpr std::size_t kMostLevels = 8;  ///< more constant levels of the drive than this share knots
constexpr int kKnots = 4;               ///< over the range of a drive that varies
constexpr double kLeaning = 200;        ///< samples that a class borrows from the wider one

LeftOutPart all_of(const RecordResult& record) {
  return {&record, record.warm_up, record.measured.size()};
}

template <class Visit>
void for_each_scored(const LeftOutPart& part, const Visit& visit) {
  const RecordResult& r = *part.record;
  if (r.diverged_at) return;
  for (std::size_t k = part.first; k < part.last; ++k)
    visit(DamperInput{0, r.velocity[k], r.drive[k]}, std::abs(r.measured[k] - r.modelled[k]), k);
}

std::vector<double> drive_knots(const std::vector<RecordResult>& records) {
  std::vector<double> knots;
  bool varies = false;
  double low = INFINITY, high = -INFINITY;
  for (const RecordResult& r : records) {
    varies = varies || !r.drive_level;
    if (r.drive_level) knots.push_back(*r.drive_level);
    for (const double drive : r.drive) low = std::min(low, drive), high = std::max(high, drive);
  }

  // A few constant levels are knots themselves.
  std::ranges::sort(knots);
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  if (!varies && knots.size() <= kMostLevels) return knots;

  // Else knots stand at even distances over the range.
  knots = {low};
  for (int k = 1; k < kKnots && high > low; ++k)
    knots.push_back(low + (high - low) * k / (kKnots - 1));
  return knots;
}

std::size_t nearest(const std::vector<double>& knots, double value) {
  const auto closer = [&](double a, double b) { return std::abs(a - value) < std::abs(b - value); };
  return static_cast<std::size_t>(std::ranges::min_element(knots, closer) - knots.begin());
}

struct Mean {
  double sum = 0, n = 0;
  void add(double value) { sum += value, ++n; }
  double leaning_on(double wider) const { return (sum + kLeaning * wider) / (n + kLeaning); }
};

}  // namespace

std::optional<ForceBand> error_shape(const std::vector<RecordResult>& training) {
  // Classes of speed and drive.
  double fastest = 0, largest_force = 0;
  for (const RecordResult& r : training)
    for_each_scored(all_of(r), [&](const DamperInput& input, double, std::size_t) {
      fastest = std::max(fastest, std::abs(input.velocity));
    });
  for (const RecordResult& r : training)
    for (const double force : r.measured) largest_force = std::max(largest_force, std::abs(force));
  ForceBand shape;
  shape.spread =
      std::ranges::any_of(training, [](const RecordResult& r) { return !r.spread.empty(); }) ? 1
                                                                                             : 0;
  for (const double share : kSpeedShares)
    if (fastest > 0) shape.speeds.push_back(share * fastest);
  shape.drives = drive_knots(training);

  // The mean error of each class, of each speed and of all.
  const std::size_t columns = shape.drives.size();
  Mean all;
  std::vector<Mean> bands(shape.speeds.size() + 1), cells(bands.size() * columns);
  for (const RecordResult& r : training)
    for_each_scored(all_of(r), [&](const DamperInput& input, double error, std::size_t) {
      const auto band = static_cast<std::size_t>(
          std::ranges::upper_bound(shape.speeds, std::abs(input.velocity)) - shape.speeds.begin());
      all.add(error);
      bands[band].add(error);
      cells[band * columns + nearest(shape.drives, input.current)].add(error);
    });
  if (all.n == 0) return std::nullopt;

  // A model without any error would have a band without a width, which no factor could open.
  const double least = 1e-9 * std::max(largest_force, 1e-9);
  for (std::size_t k = 0; k < cells.size(); ++k)
    shape.half_width.push_back(
        std::max(least, cells[k].leaning_on(bands[k / columns].leaning_on(all.sum / all.n))));
  return shape;
}

ErrorGroups relative_errors(const std::vector<RecordResult>& left_out, const ForceBand& shape) {
  ErrorGroups groups;
  for (const RecordResult& r : left_out)
    for (std::vector<double>& group : relative_errors(all_of(r), shape))
      groups.push_back(std::move(group));
  return groups;
}

ErrorGroups relative_errors(const LeftOutPart& part, const ForceBand& shape) {
  const RecordResult& r = *part.record;
  std::vector<double> group;
  for_each_scored(part, [&](const DamperInput& input, double error, std::size_t k) {
    group.push_back(error / shape.half_width_at(input, r.spread_at(k)));
  });
  return group.empty() ? ErrorGroups{} : ErrorGroups{std::move(group)};
}

std::optional<double> conformal_factor(const std::vector<ErrorGroups>& parts, double level) {
  struct Weighted {
    double error, weight;
  };

  // Parts weigh the same, and so do the records within a part.
  std::vector<Weighted> errors;
  double counted = 0;
  for (const ErrorGroups& groups : parts) {
    counted += groups.empty() ? 0 : 1;
    for (const std::vector<double>& group : groups)
      for (const double error : group)
        errors.push_back({error, 1 / static_cast<double>((group.size() + 1) * groups.size())});
  }

  // The first error, from the least on, at which the weights reach the level.
  std::ranges::sort(errors, {}, &Weighted::error);
  constexpr double kRounding = 1e-9;  // of sums of weights
  double reached = 0;
  for (const Weighted& e : errors)
    if ((reached += e.weight) >= counted * (level - kRounding)) return e.error;
  return std::nullopt;
}

std::optional<double> widening(const std::vector<ErrorGroups>& parts, double level) {
  // A single part: its records stand for parts.
  if (parts.size() == 1) {
    if (parts.front().size() < 2) return 1;
    std::vector<ErrorGroups> records;
    for (const std::vector<double>& record : parts.front()) records.push_back({record});
    return widening(records, level);
  }

  // Errors of each part relative to a band that was made from the others.
  std::vector<ErrorGroups> beside_others = parts;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    std::vector<ErrorGroups> others = parts;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(part));
    const std::optional<double> factor = conformal_factor(others, level);
    if (!factor) return std::nullopt;
    for (std::vector<double>& group : beside_others[part])
      for (double& error : group) error /= *factor;
  }
  return conformal_factor(beside_others, level);
}

std::optional<ForceBand> conformal_band(const std::optional<ForceBand>& shape,
                                        const std::vector<ErrorGroups>& parts) {
  const std::optional<double> factor = conformal_factor(parts), wider = widening(parts);
  if (!shape || !factor || !wider) return std::nullopt;
  ForceBand band = shape->scaled(*factor * *wider);
  band.level = kCoverage;
  for (const ErrorGroups& groups : parts) band.records += groups.size();
  return band;
}

Coverage coverage(const RecordResult& record, const ForceBand& band) {
  return coverage(all_of(record), band);
}

Coverage coverage(const LeftOutPart& part, const ForceBand& band) {
  const RecordResult& r = *part.record;
  Coverage covered;
  for_each_scored(part, [&](const DamperInput& input, double error, std::size_t k) {
    const double half = band.half_width_at(input, r.spread_at(k)), force = r.measured[k];
    covered.add({.samples = 1,
                 .inside = error <= half,
                 .width = 2 * half,
                 .force_min = force,
                 .force_max = force});
  });
  return covered;
}

std::vector<ErrorGroups> cover_by_parts(const ForceBand& shape,
                                        std::vector<RecordResult>& left_out) {
  constexpr std::size_t kMost = 10;  // parts that many records are dealt to in turn
  const std::vector<LeftOutPart> all = left_out_parts(left_out);
  std::vector<ErrorGroups> errors(std::min(kMost, all.size()));
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::vector<double>& group : relative_errors(all[k], shape))
      errors[k % errors.size()].push_back(std::move(group));

  // Each part is covered by the band of the others.
  const std::optional<ForceBand> band = conformal_band(shape, errors);
  for (RecordResult& record : left_out) record.band = band, record.coverage = {};
  for (std::size_t part = 0; part < errors.size(); ++part) {
    std::vector<ErrorGroups> others = errors;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(part));
    const std::optional<ForceBand> of_others = conformal_band(shape, others);
    for (std::size_t k = part; k < all.size() && of_others; k += errors.size())
      left_out[static_cast<std::size_t>(all[k].record - left_out.data())].coverage.add(
          coverage(all[k], *of_others));
  }
  return errors;
}

}  // namespace dashpot
