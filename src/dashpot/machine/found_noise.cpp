#include "dashpot/machine/found_noise.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "dashpot/base/text.h"
#include "dashpot/plant.h"

namespace dashpot {
namespace {

/// The median of what differences of this order leave, as the deviation of white noise that would
/// leave as much.
double white_by_differences(const std::vector<std::vector<double>>& signals, int order) {
  constexpr double kMedianOfNormal = 0.6745;
  std::vector<double> sizes;
  for (std::vector<double> signal : signals) {
    for (int k = 0; k < order && signal.size() > 1; ++k) {
      for (std::size_t i = 0; i + 1 < signal.size(); ++i) signal[i] = signal[i + 1] - signal[i];
      signal.pop_back();
    }
    for (const double value : signal) sizes.push_back(std::abs(value));
  }
  if (sizes.empty()) return 0;

  // Differences of white noise have the variance of the binomial coefficients' squares: C(2n, n).
  double gain = 1;
  for (int k = 1; k <= order; ++k) gain *= static_cast<double>(order + k) / k;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::ranges::nth_element(sizes, middle);
  return *middle / (kMedianOfNormal * std::sqrt(gain));
}

/// The deviation of white noise in these signals. Motions are smoother: they go with more
/// differences, noise does not. 0 where it is not told.
double white_part(const std::vector<std::vector<double>>& signals) {
  constexpr int kFew = 2, kMany = 4;
  constexpr double kAlike = 0.06;
  constexpr std::size_t kFewest = 200;
  std::size_t samples = 0;
  for (const std::vector<double>& signal : signals) samples += signal.size();
  if (samples < kFewest) return 0;
  const double few = white_by_differences(signals, kFew),
               many = white_by_differences(signals, kMany);
  return std::abs(many - few) < kAlike * few ? many : 0;
}

/// The white part of what is left at a sensor in free run, over the time that was fitted. The rest
/// is what the model lacks.
double white_left(const InPlantReport& report, std::size_t sensor) {
  std::vector<std::vector<double>> left;
  for (const InPlantTrace& trace : report.traces) {
    if (trace.modelled.size() <= sensor) return 0;
    std::vector<double> own;
    for (std::size_t k = trace.first; k < trace.training; ++k)
      own.push_back(trace.measured[sensor][k] - trace.modelled[sensor][k]);
    left.push_back(std::move(own));
  }
  return white_part(left);
}

/// Among the nuisances of a fit; 0 where they do not tell it.
double among_nuisances(const InPlantReport& report, const std::string& channel) {
  constexpr double kTold = 2;
  const auto p = std::ranges::find(report.nuisances, "noise of " + channel, &FittedParameter::name);
  if (p == report.nuisances.end() || p->weak || p->at_bound) return 0;
  return p->high < kTold * p->value && p->value < kTold * p->low ? p->value : 0;
}

/// How far the zero may be off: a few recordings tell it roughly, so twice what they show.
double zero_of(const InPlantReport& report, const std::string& channel, double noise) {
  constexpr double kRoughly = 2;
  double squares = 0, count = 0;
  for (const SensorFigures& figure : report.sensors)
    if (figure.channel == channel) {
      squares += figure.offset * figure.offset;
      count += 1;
    }
  return count > 0 ? std::max(noise, kRoughly * std::sqrt(squares / count)) : noise;
}

/// What was found in place of what is not stated.
void take(IdentifiedNoise& identified, const std::string& channel, const std::string& unit,
          const ModelFile& file, const std::string& model, double& noise) {
  if (noise > 0) return;
  if (identified.deviation > 0) {
    identified.from = "the plant's file";
  } else {
    const auto same = [&](const FoundNoise& one) {
      return one.channel == channel && one.unit == unit;
    };
    const auto one = std::ranges::find_if(file.noise_found, same);
    if (one == file.noise_found.end()) return;
    identified = {one->deviation, one->zero, model};
  }
  noise = identified.deviation;
}

}  // namespace

std::vector<FoundNoise> found_noise(const InPlantSetup& setup, const InPlantReport& report) {
  std::vector<FoundNoise> found;
  if (!report.has_models()) return found;
  const Plant plant = make_plant(*setup.model, setup.known);

  // Of sensors that state none: what was sought beside all else, or what is left.
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    const PlantSensor& sensor = setup.sensors[s];
    if (sensor.noise > 0) continue;
    const std::string name = "noise of " + sensor.channel;
    const bool was_sought =
        std::ranges::find(report.nuisances, name, &FittedParameter::name) != report.nuisances.end();
    const double noise =
        was_sought ? among_nuisances(report, sensor.channel) : white_left(report, s);
    found.push_back({sensor.channel, unit_of(sensor.place, plant), noise,
                     noise > 0 ? zero_of(report, sensor.channel, noise) : 0});
  }

  // Of inputs what was sought alone.
  for (const PlantInputChannel& input : setup.inputs)
    if (const double noise = among_nuisances(report, input.channel);
        noise > 0 && input.noise == 0 && !input.road)
      found.push_back({input.channel, unit_of(input.place.kind), noise, 0});
  return found;
}

std::vector<FoundNoise> told_noise(const InPlantReport& report) {
  std::vector<FoundNoise> told;
  std::ranges::copy_if(report.noise, std::back_inserter(told),
                       [](const FoundNoise& one) { return one.deviation > 0; });
  return told;
}

std::vector<std::string> noise_alone(const InPlantSetup& setup,
                                     const std::vector<PlantRecording>& recordings) {
  constexpr double kHardlyMore = 0.9;
  std::vector<std::string> channels;
  for (const PlantSensor& sensor : setup.sensors) {
    std::vector<std::vector<double>> signals;
    double square = 0, count = 0;
    for (const PlantRecording& recording : recordings) {
      signals.push_back(recording.channel(sensor.channel).samples);
      const double mean = std::accumulate(signals.back().begin(), signals.back().end(), 0.0) /
                          static_cast<double>(signals.back().size());
      for (const double sample : signals.back()) square += (sample - mean) * (sample - mean);
      count += static_cast<double>(signals.back().size());
    }
    if (white_part(signals) > kHardlyMore * std::sqrt(square / count))
      channels.push_back(sensor.channel);
  }
  return channels;
}

InPlantSetup with_identified_noise(InPlantSetup setup, const ModelFile& file,
                                   const std::string& model) {
  const Plant plant = make_plant(*setup.model, setup.known);
  for (PlantSensor& sensor : setup.sensors) {
    take(sensor.identified, sensor.channel, unit_of(sensor.place, plant), file, model,
         sensor.noise);
    if (!sensor.identified.from.empty() && sensor.zero == 0) sensor.zero = sensor.identified.zero;
  }
  for (PlantInputChannel& input : setup.inputs)
    if (!input.road && input.follows.empty())
      take(input.identified, input.channel, unit_of(input.place.kind), file, model, input.noise);
  return setup;
}

std::string identified_noise_words(const InPlantSetup& setup, const PrintUnits& units) {
  const Plant plant = make_plant(*setup.model, setup.known);
  std::vector<std::string> noises, files;
  const auto add = [&](const IdentifiedNoise& one, const std::string& channel,
                       const std::string& unit) {
    if (one.from.empty()) return;
    const PrintUnit shown = units.of(unit);
    noises.push_back(channel + " " + format_number(shown.factor * one.deviation, 3) + " " +
                     shown.name);
    if (std::ranges::find(files, one.from) == files.end()) files.push_back(one.from);
  };
  for (const PlantSensor& sensor : setup.sensors)
    add(sensor.identified, sensor.channel, unit_of(sensor.place, plant));
  for (const PlantInputChannel& input : setup.inputs)
    add(input.identified, input.channel, unit_of(input.place.kind));
  if (noises.empty()) return {};
  return "Noise not stated, as 'identify --in' found it (" + join(files, ", ") +
         "): " + join(noises, ", ") + ".";
}

}  // namespace dashpot
