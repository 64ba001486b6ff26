#include "dashpot/record/drive_levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dashpot {
namespace {

/// The recorded drive of a record that has no level yet; null where there is none.
const Channel* recorded_drive(const Record& record) {
  if (record.drive_level) return nullptr;
  const Channel* current = record.find("current");
  return current ? current : record.find("voltage");
}

/// How far samples of one level may lie apart, and the step in which levels are set; A or V.
struct Resolution {
  double noise = 0.02, step = 0.01;
};

/// The largest of 1, 2 and 5 times a power of ten that is not above this.
double round_step(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= most) return digit * power;
  return power;
}

/// Whether a drive that moves is that of a source, and not the noise of a zero: it stays on one
/// side of zero, and its samples follow each other.
bool is_driven(const std::vector<double>& samples, double largest) {
  constexpr double kOneSide = 0.1, kFollows = 0.2;  // noise of a zero: 1; 2 where it is white
  const auto [low, high] = std::ranges::minmax(samples);
  if (std::min(-low, high) > kOneSide * largest) return false;
  const double mean =
      std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
  double steps = 0, deviations = 0;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    steps += (samples[k] - samples[k - 1]) * (samples[k] - samples[k - 1]);
    deviations += (samples[k] - mean) * (samples[k] - mean);
  }
  return steps < kFollows * deviations;
}

/// From the largest drive of all records and the quietest of them.
Resolution resolution_of(std::span<const Record> records) {
  constexpr double kLeast = 0.005, kUsual = 0.5, kAboveNoise = 4;
  constexpr double kNoise = 25, kSteps = 50;
  double largest = 0, quietest = INFINITY;
  for (const Record& record : records)
    if (const Channel* drive = recorded_drive(record)) {
      const auto [low, high] = std::ranges::minmax(drive->samples);
      largest = std::max({largest, std::abs(low), std::abs(high)});
      quietest = std::min(quietest, high - low);
    }
  if (largest < kLeast || largest >= kUsual) return {};

  // Where every record moves, it may be by noise alone.
  if (largest < kAboveNoise * quietest && !std::ranges::all_of(
                                              records,
                                              [&](const Record& record) {
                                                const Channel* drive = recorded_drive(record);
                                                return !drive || is_driven(drive->samples, largest);
                                              }))
    return {};
  return {largest / kNoise, round_step(largest / kSteps)};
}

}  // namespace

void find_drive_levels(std::span<Record> records) {
  constexpr double kShare = 0.05;
  const Resolution resolution = resolution_of(records);
  const double steps = std::round(1 / resolution.step);
  for (Record& record : records) {
    const Channel* drive = recorded_drive(record);
    if (!drive) continue;
    const auto [low, high] = std::ranges::minmax(drive->samples);
    const double mean = std::accumulate(drive->samples.begin(), drive->samples.end(), 0.0) /
                        static_cast<double>(record.size());
    if (high - low <= std::max(resolution.noise, kShare * std::abs(mean)))
      record.drive_level = std::round(mean * steps) / steps + 0.0;  // no -0
  }
}

}  // namespace dashpot
