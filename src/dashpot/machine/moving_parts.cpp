#include "dashpot/machine/moving_parts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "dashpot/base/text.h"
#include "dashpot/machine/bench_start.h"

namespace dashpot {
namespace {

constexpr std::size_t kBlock = 50;        // samples that are looked at together
constexpr std::size_t kBlocksKept = 2;    // of a still end, before the plant moves
constexpr std::size_t kFewestBlocks = 8;  // that are worth leaving out

/// The range of a signal without its thousandth part at either end, which may be spikes.
double usual_range(std::vector<double> samples) {
  const std::size_t spikes = samples.size() / 1000;
  const auto at = [&](std::size_t k) {
    const auto place = samples.begin() + static_cast<std::ptrdiff_t>(k);
    std::ranges::nth_element(samples, place);
    return *place;
  };
  const double low = at(spikes);
  return at(samples.size() - 1 - spikes) - low;
}

/// Blocks from the first sample on in which a signal stays at the level of the first of them.
template <class Samples>
std::size_t still_blocks(const Samples& samples, std::size_t count, double range) {
  constexpr double kStill = 0.04;  // of the range, rms; a random motion's own is a sixth of it
  double level = 0;
  for (std::size_t k = 0; k < kBlock; ++k)
    level += samples[static_cast<std::ptrdiff_t>(k)] / kBlock;
  std::size_t block = 0;
  for (; (block + 1) * kBlock <= count; ++block) {
    double squares = 0;
    for (std::size_t k = block * kBlock; k < (block + 1) * kBlock; ++k) {
      const double off = samples[static_cast<std::ptrdiff_t>(k)] - level;
      squares += off * off / kBlock;
    }
    if (std::sqrt(squares) > kStill * range) break;
  }
  return block;
}

/// What shows whether the plant moves.
std::vector<std::string> channels_in_motion(const InPlantSetup& setup) {
  std::vector<std::string> names;
  for (const PlantInputChannel& input : setup.inputs)
    if (!input.channel.empty() && input.follows.empty()) names.push_back(input.channel);
  for (const PlantSensor& sensor : setup.sensors) names.push_back(sensor.channel);
  return names;
}

/// Samples that are left out at the beginning and at the end of a recording.
struct StillEnds {
  std::size_t first = 0, last = 0;
};

StillEnds ends_of(const InPlantSetup& setup, const PlantRecording& recording) {
  if (recording.samples < 2 * kBlock) return {};

  // As long as none of them moves.
  std::size_t first = recording.samples / kBlock, last = first;
  for (const std::string& name : channels_in_motion(setup)) {
    const std::vector<double>& samples = recording.channel(name).samples;
    const double range = usual_range(samples);
    if (!(range > 0)) continue;
    first = std::min(first, still_blocks(samples.begin(), samples.size(), range));
    last = std::min(last, still_blocks(samples.rbegin(), samples.size(), range));
  }
  const auto left_out = [](std::size_t blocks) {
    return blocks >= kBlocksKept + kFewestBlocks ? (blocks - kBlocksKept) * kBlock : 0;
  };
  const StillEnds ends{left_out(first), left_out(last)};
  return ends.first + ends.last < recording.samples ? ends : StillEnds{};
}

double variance_of(std::span<const double> samples) {
  double sum = 0, squares = 0;
  for (const double sample : samples) {
    sum += sample - samples.front();
    squares += (sample - samples.front()) * (sample - samples.front());
  }
  const auto count = static_cast<double>(samples.size());
  return std::max(0.0, squares / count - sum * sum / (count * count));
}

/// Where over `horizon` samples, and over their first tenth, a recording first moves as much as on
/// the whole of its `fitted` samples; 0 where it does so from the beginning, or at least half as
/// much.
std::size_t lively_from(const InPlantSetup& setup, const PlantRecording& recording,
                        std::size_t fitted, std::size_t horizon) {
  constexpr double kQuiet = 0.25, kLively = 1;  // of the power
  const std::size_t tenth = horizon / 10;
  const std::vector<std::string> names = channels_in_motion(setup);
  const auto power_over = [&](std::size_t first, std::size_t count) {
    double sum = 0;
    for (const std::string& name : names) {
      const auto samples = std::span(recording.channel(name).samples).first(fitted);
      sum += variance_of(samples.subspan(first, count)) / std::max(variance_of(samples), 1e-300) /
             static_cast<double>(names.size());
    }
    return sum;
  };
  if (fitted < 2 * horizon || power_over(0, horizon) >= kQuiet) return 0;

  // The first place that is as lively, or the liveliest.
  std::size_t best = 0;
  double most = 0;
  for (std::size_t first = 0; first + horizon <= fitted && most < kLively; first += tenth) {
    const double power = std::min(power_over(first, horizon), power_over(first, tenth));
    if (power <= most) continue;
    most = power;
    best = first;
  }
  return best;
}

std::string seconds_text(std::size_t samples, double sample_time) {
  return format_number(static_cast<double>(samples) * sample_time, 3) + " s";
}

}  // namespace

std::vector<PlantRecording> moving_parts(const InPlantSetup& setup,
                                         const std::vector<PlantRecording>& recordings) {
  std::vector<PlantRecording> parts;
  for (const PlantRecording& one : recordings) {
    const auto [first, last] = ends_of(setup, one);
    parts.push_back(part_of(one, first, one.samples - last));
  }
  return parts;
}

std::string still_ends(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings) {
  std::vector<std::string> told;
  for (const PlantRecording& one : recordings) {
    const auto [first, last] = ends_of(setup, one);
    std::vector<std::string> ends;
    if (first > 0) ends.push_back("first " + seconds_text(first, one.sample_time));
    if (last > 0) ends.push_back("last " + seconds_text(last, one.sample_time));
    if (!ends.empty()) told.push_back(one.name + " (its " + join(ends, " and its ") + ')');
  }
  if (told.empty()) return {};
  return "Left out is where the plant stands still: " + join(told, ", ") + '.';
}

std::vector<PlantRecording> lively_parts(const InPlantSetup& setup,
                                         const std::vector<PlantRecording>& recordings,
                                         std::size_t horizon) {
  if (setup.from_rest) return {};
  std::vector<PlantRecording> parts;
  bool differs = false;
  for (const PlantRecording& one : recordings) {
    const std::size_t fitted = fitted_samples(setup, one);
    const std::size_t first = lively_from(setup, one, fitted, horizon);
    const auto count = static_cast<std::size_t>(
        std::ceil(static_cast<double>(fitted - first) / (1 - setup.held_back)));
    parts.push_back(part_of(one, first, std::min(one.samples, first + count)));
    differs |= first > 0;
  }
  return differs ? parts : std::vector<PlantRecording>{};
}

}  // namespace dashpot
