#include "dashpot/machine/sensor_faults.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/plant.h"

namespace dashpot {
namespace {

constexpr std::size_t kSettled = 50;  // samples, until the filter knows where it is

SampleRange longest_at_one_value(const std::vector<double>& shown) {
  SampleRange longest;
  for (std::size_t first = 0, k = 1; k <= shown.size(); ++k) {
    if (k < shown.size() && shown[k] == shown[first]) continue;
    if (k - first > longest.length()) longest = {first, k};
    first = k;
  }
  return longest;
}

/// The mean square of what a sensor showed beyond what was expected, over its variance, within the
/// stretch and in the rest; nothing where either has few samples.
struct Beyond {
  double within = 0, rest = 0;
};
std::optional<Beyond> beyond_of(const ObservedRun& run, std::size_t sensor, SampleRange stretch) {
  constexpr double kFewest = 20;
  double squares[2] = {0, 0}, counts[2] = {0, 0};
  for (std::size_t k = kSettled; k < run.samples.size(); ++k) {
    const double beyond = run.samples[k].innovation[sensor],
                 variance = run.samples[k].variance[sensor];
    if (!(variance > 0)) continue;
    const bool is_within = k >= stretch.first && k < stretch.end;
    squares[is_within] += beyond * beyond / variance;
    counts[is_within] += 1;
  }
  if (counts[0] < kFewest || counts[1] < kFewest) return std::nullopt;
  return Beyond{squares[1] / counts[1], squares[0] / counts[0]};
}

/// A straight line of one sensor, from 0 to `amount` along a recording, and the samples without it.
struct Line {
  std::size_t sensor = 0;
  double amount = 0;
  double misfit = INFINITY;  ///< -2 log of the likelihood that is left
  double correlation = 1;    ///< as many times as under independent samples its score scatters
};

ObservedSamples without(const ObservedSamples& samples, std::size_t sensor, double amount) {
  ObservedSamples rest = samples;
  for (std::size_t k = 0; k < samples.count; ++k)
    rest.measured[k * samples.sensors + sensor] -=
        amount * static_cast<double>(k) / static_cast<double>(samples.count);
  return rest;
}

double misfit_of(const Innovations& told, std::size_t sensors) {
  double sum = told.beyond.empty() ? INFINITY : 0;
  for (std::size_t at = kSettled * sensors; at < told.beyond.size(); ++at)
    if (told.variance[at] > 0)
      sum += std::log(told.variance[at]) + told.beyond[at] * told.beyond[at] / told.variance[at];
  return sum;
}

/// The line that is left in samples, by what a line of this length changes. `told`: of the samples.
Line line_of(const PlantObserver& observer, const ObservedSamples& samples, std::size_t sensor,
             double length, const Innovations& told) {
  constexpr std::size_t kPieces = 24;
  Line line{.sensor = sensor, .misfit = misfit_of(told, samples.sensors)};
  const Innovations beside = innovations(observer, without(samples, sensor, -length));
  if (beside.beyond.empty()) return line;

  // Score and information of each piece of time, and of all.
  double scores[kPieces] = {}, informations[kPieces] = {}, score = 0, information = 0;
  for (std::size_t at = kSettled * samples.sensors; at < told.beyond.size(); ++at) {
    if (!(told.variance[at] > 0)) continue;
    const double by = (beside.beyond[at] - told.beyond[at]) / length;
    const std::size_t piece = at * kPieces / told.beyond.size();
    scores[piece] += by * told.beyond[at] / told.variance[at];
    informations[piece] += by * by / told.variance[at];
  }
  for (std::size_t p = 0; p < kPieces; ++p) {
    score += scores[p];
    information += informations[p];
  }
  if (!(information > 0)) return line;

  // How far the pieces scatter about the line.
  line.amount = score / information;
  line.misfit -= score * score / information;
  double squares = 0;
  for (std::size_t p = 0; p < kPieces; ++p)
    squares += std::pow(scores[p] - line.amount * informations[p], 2);
  line.correlation = std::max(1.0, squares / information);
  return line;
}

/// The line once more along the motion that the filter sees without it, which is another where the
/// line is long.
Line refined(const PlantObserver& observer, const ObservedSamples& samples, Line line,
             double length) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const ObservedSamples rest = without(samples, line.sensor, line.amount);
    Line more = line_of(observer, rest, line.sensor, length, innovations(observer, rest));
    more.amount += line.amount;
    line = more;
  }
  return line;
}

/// What a filter leaves of the samples, and the line of one sensor that explains most of that.
struct Asked {
  double misfit = INFINITY;
  Line line;
};
Asked asked_of(const PlantObserver& observer, const ObservedSamples& samples,
               std::span<const double> zeros) {
  const Innovations told = innovations(observer, samples);
  Asked asked{.misfit = misfit_of(told, samples.sensors), .line = {}};
  for (std::size_t s = 0; s < samples.sensors; ++s) {
    const Line line = line_of(observer, samples, s, zeros[s], told);
    if (line.misfit < asked.line.misfit) asked.line = line;
  }
  return asked;
}

}  // namespace

std::vector<std::string> held_sensors(const InPlantSetup& setup, const PlantRecording& recording,
                                      const ObservedRun& run) {
  constexpr double kShortest = 0.1, kFurther = 3;  // s; times the rms of the rest
  const Plant plant = make_plant(*setup.model, setup.known);
  std::vector<std::string> sentences;
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    const PlantSensor& sensor = setup.sensors[s];
    const std::vector<double>& shown = recording.channel(sensor.channel).samples;
    const SampleRange held = longest_at_one_value(shown);
    const double step = recording.sample_time;
    if (static_cast<double>(held.length()) * step < kShortest) continue;
    const auto beyond = beyond_of(run, s, held);
    if (!beyond || beyond->within < kFurther * kFurther * beyond->rest) continue;
    sentences.push_back(
        recording.name + ", " + sensor.channel + ": stands at " +
        format_number(shown[held.first], 3) + ' ' + unit_of(sensor.place, plant) + " from " +
        format_number(static_cast<double>(held.first) * step, 3) + " to " +
        format_number(static_cast<double>(held.end) * step, 3) +
        " s, where the plant moves on by all else: a sensor that is stuck, lost or at the end of "
        "its range; cut the recording there, or leave the sensor out");
  }
  return sentences;
}

std::string drifting_sensor(const InPlantSetup& setup, const PlantRecording& recording,
                            const ObservedSamples& samples, std::span<const PlantObserver> tried,
                            std::span<const double> zeros, std::size_t recordings, int threads) {
  constexpr double kFalseAlarms = 0.001, kPieceDegrees = 23, kShortest = 3;

  // Any sensor in any recording may be taken for one that drifts.
  const auto sensors = static_cast<double>(setup.sensors.size() * recordings);
  const double least = students_t_quantile(kPieceDegrees, 1 - 0.5 * kFalseAlarms / sensors);

  // Under the least slow errors a line gains most: where it does not there, it does nowhere.
  std::vector<Asked> asked(tried.size());
  asked.back() = asked_of(tried.back(), samples, zeros);
  if (!(asked.back().misfit - asked.back().line.misfit > least * least)) return {};
  parallel_for(tried.size(), threads, [&](std::size_t k) {
    if (k + 1 < tried.size()) asked[k] = asked_of(tried[k], samples, zeros);
    Line& line = asked[k].line;
    if (std::isfinite(line.misfit)) line = refined(tried[k], samples, line, zeros[line.sensor]);
  });

  // The best with a line beside the best without.
  const double without_line = std::ranges::min_element(asked, {}, &Asked::misfit)->misfit;
  const Line line =
      std::ranges::min_element(asked, {}, [](const Asked& one) { return one.line.misfit; })->line;
  const double gain = without_line - line.misfit;
  if (!(gain > least * least * line.correlation)) return {};
  if (std::abs(line.amount) < kShortest * zeros[line.sensor]) return {};
  const PlantSensor& sensor = setup.sensors[line.sensor];
  const Plant plant = make_plant(*setup.model, setup.known);
  return recording.name + ", " + sensor.channel + ": its zero seems to drift, by some " +
         format_number(line.amount, 2) + ' ' + unit_of(sensor.place, plant) +
         " along the recording: that explains what it shows better than any slow error of the "
         "damper's force does; motion and force lean by it, beyond their bands: take it off, or "
         "observe shorter pieces (a load that changes slowly, of which the plant says nothing, "
         "looks alike)";
}

}  // namespace dashpot
