#include "dashpot/machine/recording_parts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "dashpot/base/text.h"

namespace dashpot {
namespace {

constexpr std::size_t kBlock = 50;  // samples that are looked at together

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

/// Blocks from the beginning of a signal on in which it stays at the level of the first of them.
std::size_t still_blocks(std::span<const double> samples, double range) {
  constexpr double kStill = 0.04;  // of the range, rms; a random motion's own is a sixth of it
  double level = 0;
  for (const double sample : samples.first(kBlock)) level += sample / kBlock;
  std::size_t block = 0;
  for (; (block + 1) * kBlock <= samples.size(); ++block) {
    double squares = 0;
    for (const double sample : samples.subspan(block * kBlock, kBlock))
      squares += (sample - level) * (sample - level) / kBlock;
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

/// Where for some time all channels stay at their level, in order.
std::vector<SampleRange> still_stretches(const InPlantSetup& setup,
                                         const PlantRecording& recording) {
  constexpr std::size_t kFewest = 10;  // blocks
  std::vector<std::pair<std::span<const double>, double>> signals;
  for (const std::string& name : channels_in_motion(setup)) {
    const std::vector<double>& samples = recording.channel(name).samples;
    if (const double range = usual_range(samples); range > 0) signals.emplace_back(samples, range);
  }

  std::vector<SampleRange> stretches;
  const std::size_t blocks = recording.samples / kBlock;
  for (std::size_t block = 0; block < blocks; ++block) {
    std::size_t still = blocks - block;
    for (const auto& [samples, range] : signals)
      still = std::min(still, still_blocks(samples.subspan(block * kBlock), range));
    if (still < kFewest) continue;
    stretches.push_back({block * kBlock, (block + still) * kBlock});
    block += still;
  }
  return stretches;
}

/// The stretches that are left out: at either end; where nothing measures the road, which is taken
/// as the same all along, those between too.
std::vector<SampleRange> left_out_of(const InPlantSetup& setup, const PlantRecording& recording) {
  constexpr std::size_t kKept = 2 * kBlock;  // samples beside those that move
  constexpr double kPause = 1;               // s
  std::vector<SampleRange> left_out;
  for (auto [first, end] : still_stretches(setup, recording)) {
    const bool at_start = first == 0, at_end = end + kBlock > recording.samples;
    const double lasts = recording.sample_time * static_cast<double>(end - first);
    if (!at_start && !at_end && !(unmeasured_road(setup) && lasts >= kPause)) continue;
    if (!at_start) first += kKept;
    end = at_end ? recording.samples : end - kKept;
    left_out.push_back({first, end});
  }
  return left_out;
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
  const std::size_t tenth = std::max<std::size_t>(1, horizon / 10);
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

std::string seconds_at(std::size_t sample, const PlantRecording& recording) {
  return format_number(static_cast<double>(sample) * recording.sample_time, 3);
}

}  // namespace

PlantRecording part_of(const PlantRecording& recording, std::size_t first, std::size_t end) {
  PlantRecording part = recording;
  part.samples = end - first;
  for (Channel& channel : part.channels)
    channel.samples.assign(
        recording.channel(channel.name).samples.begin() + static_cast<std::ptrdiff_t>(first),
        recording.channel(channel.name).samples.begin() + static_cast<std::ptrdiff_t>(end));
  return part;
}

std::size_t fitted_samples(const InPlantSetup& setup, const PlantRecording& recording) {
  return static_cast<std::size_t>((1 - setup.held_back) * static_cast<double>(recording.samples));
}

std::vector<PlantRecording> fitted_parts(const InPlantSetup& setup,
                                         const std::vector<PlantRecording>& recordings) {
  std::vector<PlantRecording> parts;
  for (const PlantRecording& recording : recordings)
    parts.push_back(part_of(recording, static_cast<std::size_t>(setup.skip / recording.sample_time),
                            fitted_samples(setup, recording)));
  return parts;
}

std::vector<SampleRange> moving_stretches(const InPlantSetup& setup,
                                          const PlantRecording& recording) {
  constexpr std::size_t kFewest = 1000;  // samples between two pauses
  std::vector<SampleRange> kept{{0, recording.samples}};
  for (const auto& [first, end] : left_out_of(setup, recording)) {
    kept.back().end = first;
    kept.push_back({end, recording.samples});
  }
  std::erase_if(kept, [&](const SampleRange& one) {
    return one.length() == 0 || (one.length() < kFewest && kept.size() > 1);
  });
  return kept.empty() ? std::vector<SampleRange>{{0, recording.samples}} : kept;
}

std::vector<PlantRecording> moving_parts(const InPlantSetup& setup,
                                         const std::vector<PlantRecording>& recordings) {
  std::vector<PlantRecording> parts;
  for (const PlantRecording& one : recordings) {
    const std::vector<SampleRange> kept = moving_stretches(setup, one);
    for (const auto& [first, end] : kept) {
      parts.push_back(part_of(one, first, end));
      if (kept.size() > 1)
        parts.back().name += ", " + seconds_at(first, one) + " to " + seconds_at(end, one) + " s";
    }
  }
  return parts;
}

std::string still_parts(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings) {
  std::vector<std::string> told;
  for (const PlantRecording& one : recordings) {
    std::vector<std::string> stretches;
    for (const auto& [first, end] : left_out_of(setup, one))
      stretches.push_back(seconds_at(first, one) + " to " + seconds_at(end, one) + " s");
    if (!stretches.empty()) told.push_back(one.name + " (" + join(stretches, ", ") + ')');
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
