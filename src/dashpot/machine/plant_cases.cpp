#include "dashpot/machine/plant_cases.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/machine/between_samples.h"
#include "dashpot/machine/damper_drive.h"
#include "dashpot/machine/sensor_unknowns.h"

namespace dashpot {
namespace {

bool is_constant(std::span<const double> samples) {
  const auto [low, high] = std::ranges::minmax(samples);
  return high - low <= 1e-12 * std::max(std::abs(low), std::abs(high));
}

}  // namespace

PlantCases make_cases(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings,
                      std::size_t steps, PlantMethod method) {
  constexpr std::size_t kFirstGuess = 2, kFewest = 200;
  PlantCases cases{.all = {}, .steps = steps > 0 ? steps : kFirstGuess, .method = method};
  for (const PlantRecording& recording : recordings) {
    require_units(setup, recording);
    PlantCase one{.name = recording.name};
    one.driving = {.sample_time = recording.sample_time,
                   .samples = recording.samples,
                   .steps = cases.steps,
                   .method = method,
                   .value = {},
                   .rate = {},
                   .current = {},
                   .leap_time = recording.sample_time};

    // The part that is fitted: nobody knows what filters held before the first sample.
    double skip = setup.skip;
    for (const PlantSensor& sensor : setup.sensors)
      if (!setup.from_rest)
        skip = std::max(skip, memory_of(slowest_filter(sensor, recordings.front().sample_time)));
    one.first = static_cast<std::size_t>(skip / recording.sample_time);
    one.training =
        static_cast<std::size_t>((1 - setup.held_back) * static_cast<double>(recording.samples));
    if (one.training < one.first + kFewest)
      throw Error(recording.name,
                  (setup.held_back > 0 ? "leaves " : "has ") + std::to_string(one.training) +
                      (setup.held_back > 0 ? " samples to fit" : " samples"),
                  "at least " + std::to_string(kFewest) + " behind " +
                      (skip > setup.skip ? "the " + format_number(skip, 3) +
                                               " s in which sensors' filters forget what was before"
                                         : "those that are skipped"));

    // The inputs between the samples.
    for (const PlantInputChannel& input : setup.inputs) {
      const std::vector<double>& samples = recording.channel(input.channel).samples;
      if (is_constant(samples))
        throw Error(recording.name + ", " + input.channel,
                    "is constant: nothing moves the plant, so that nothing can be told of it",
                    "record while the plant is shaken, pushed or driven over a road");
      FinerSignal finer = band_limited(samples, recording.sample_time, one.driving.stride());
      one.driving.value.push_back(std::move(finer.value));
      one.driving.rate.push_back(std::move(finer.rate));
    }
    for (std::size_t d = 0; d < setup.dampers(); ++d)
      one.driving.current.push_back(straight_lines(drive_samples(setup.drive_of(d), recording),
                                                   recording.sample_time, one.driving.stride())
                                        .value);
    one.levels = held_levels(with_held_drives(setup, {&recording, 1}));

    // What the sensors showed.
    for (const PlantSensor& sensor : setup.sensors) {
      one.measured.push_back(recording.channel(sensor.channel).samples);
      if (is_constant(one.measured.back()))
        throw Error(recording.name + ", " + sensor.channel, "is constant",
                    "a sensor that shows the plant's motion");
    }
    cases.all.push_back(std::move(one));
  }
  if (cases.all.empty()) throw Error("recordings", "there are none", "name at least one");
  return cases;
}

DriveRange drive_range(const PlantCases& cases) {
  DriveRange range{INFINITY, -INFINITY, false, 1};
  std::set<double> levels;
  for (const PlantCase& one : cases.all)
    for (const std::vector<double>& current : one.driving.current) {
      const auto [low, high] = std::ranges::minmax(current);
      range.varies |= high > low;
      range.low = std::min(range.low, low);
      range.high = std::max(range.high, high);
      levels.insert(low);
    }
  if (!range.varies) range.levels = levels.size();
  return range;
}

}  // namespace dashpot
