#include "dashpot/machine/sensor_doubts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "dashpot/base/text.h"

namespace dashpot {
namespace {

constexpr double kFarAway = 0.3;  // rms of the error over that of the signal

/// A sensor in one recording over the time that was fitted, as measured and modelled, each without
/// its mean and over the rms of what was measured.
struct SensorPair {
  double sample_time = 0;
  std::vector<double> measured, modelled;
};

std::vector<double> without_mean(std::span<const double> samples) {
  const double mean =
      std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
  std::vector<double> rest(samples.begin(), samples.end());
  for (double& value : rest) value -= mean;
  return rest;
}

double product_of(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0) / static_cast<double>(a.size());
}

std::vector<SensorPair> pairs_of(std::size_t sensor, const std::vector<InPlantTrace>& traces) {
  std::vector<SensorPair> pairs;
  for (const InPlantTrace& trace : traces) {
    const auto fitted = [&](const std::vector<double>& samples) {
      return without_mean(std::span(samples).subspan(trace.first, trace.training - trace.first));
    };
    SensorPair pair{trace.sample_time, fitted(trace.measured[sensor]),
                    fitted(trace.modelled[sensor])};
    const double rms = std::sqrt(product_of(pair.measured, pair.measured));
    for (auto* samples : {&pair.measured, &pair.modelled})
      for (double& value : *samples) value /= rms;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

/// A flaw of a sensor, and what it would leave: power over that of the signal, the mean of the
/// recordings.
struct Flaw {
  double value = 0, left = 0;
};

/// The mean over the recordings of what `of` tells of each.
template <typename Of>
double mean_over(const std::vector<SensorPair>& pairs, Of of) {
  double sum = 0;
  for (const SensorPair& pair : pairs) sum += of(pair);
  return sum / static_cast<double>(pairs.size());
}

double power_left(const SensorPair& pair, double factor) {
  double sum = 0;
  for (std::size_t k = 0; k < pair.measured.size(); ++k)
    sum += std::pow(pair.measured[k] - factor * pair.modelled[k], 2);
  return sum / static_cast<double>(pair.measured.size());
}

double left_at(const std::vector<SensorPair>& pairs) {
  return mean_over(pairs, [](const SensorPair& p) { return power_left(p, 1); });
}

/// It shows so many times what the model does.
Flaw as_factor(const std::vector<SensorPair>& pairs) {
  const auto both = [](const SensorPair& p) { return product_of(p.measured, p.modelled); };
  const auto alone = [](const SensorPair& p) { return product_of(p.modelled, p.modelled); };
  const double factor = mean_over(pairs, both) / mean_over(pairs, alone);
  return {factor, mean_over(pairs, [&](const SensorPair& p) { return power_left(p, factor); })};
}

/// What is left where the sensor shows the model's motion `late` seconds later, straight between
/// samples; the same samples whatever the delay is, so that no delay gains by leaving some out.
double left_behind(const SensorPair& pair, double late, double most) {
  const auto margin = static_cast<std::size_t>(std::ceil(most / pair.sample_time)) + 1;
  if (2 * margin >= pair.measured.size()) return INFINITY;
  std::vector<double> error;
  for (std::size_t k = margin; k + margin < pair.measured.size(); ++k) {
    const double place = static_cast<double>(k) - late / pair.sample_time;
    const auto below = static_cast<std::size_t>(place);
    error.push_back(pair.measured[k] - std::lerp(pair.modelled[below], pair.modelled[below + 1],
                                                 place - static_cast<double>(below)));
  }
  const std::vector<double> rest = without_mean(error);
  return product_of(rest, rest);
}

/// It comes so late, s; early where that is negative.
Flaw as_delay(const std::vector<SensorPair>& pairs) {
  constexpr double kMost = 0.1;  // s
  constexpr int kMostSteps = 100;
  const double sample = std::ranges::min(pairs, {}, &SensorPair::sample_time).sample_time;
  const double step = std::max(sample, kMost / kMostSteps);
  const auto left = [&](double late) {
    return mean_over(pairs, [&](const SensorPair& p) { return left_behind(p, late, kMost); });
  };

  Flaw best{0, INFINITY};
  for (int j = -static_cast<int>(kMost / step); j * step <= kMost; ++j)
    if (const double now = left(j * step); now < best.left) best = {j * step, now};

  // Between the steps, by a parabola.
  if (std::abs(best.value) + step > kMost) return best;
  const double before = left(best.value - step), after = left(best.value + step);
  const double bend = before - 2 * best.left + after;
  if (bend > 0) best.value += 0.5 * step * (before - after) / bend;
  return best;
}

/// Its zero goes along a straight line, another one in each recording; the largest rise over a
/// recording, over the rms of the signal.
Flaw as_drift(const std::vector<SensorPair>& pairs) {
  Flaw flaw;
  for (const SensorPair& pair : pairs) {
    const std::size_t count = pair.measured.size();
    std::vector<double> line(count), error(count);
    for (std::size_t k = 0; k < count; ++k) {
      line[k] = static_cast<double>(k) / static_cast<double>(count - 1) - 0.5;
      error[k] = pair.measured[k] - pair.modelled[k];
    }
    const double rise = product_of(line, error) / product_of(line, line);
    if (std::abs(rise) > std::abs(flaw.value)) flaw.value = rise;
    flaw.left += product_of(error, error) - rise * rise * product_of(line, line);
  }
  flaw.left /= static_cast<double>(pairs.size());
  return flaw;
}

/// A hundredth of the samples, those furthest from the model, are no motion; how many they are.
Flaw as_spikes(const std::vector<SensorPair>& pairs) {
  constexpr std::size_t kFew = 100;
  Flaw flaw;
  for (const SensorPair& pair : pairs) {
    std::vector<double> squares;
    for (std::size_t k = 0; k < pair.measured.size(); ++k)
      squares.push_back(std::pow(pair.measured[k] - pair.modelled[k], 2));
    const auto rest = squares.end() - static_cast<std::ptrdiff_t>(squares.size() / kFew);
    std::nth_element(squares.begin(), rest, squares.end());
    flaw.value += static_cast<double>(squares.end() - rest);
    flaw.left += std::accumulate(squares.begin(), rest, 0.0) / static_cast<double>(squares.size());
  }
  flaw.left /= static_cast<double>(pairs.size());
  return flaw;
}

/// How many samples stand at the greatest or the least value, where these are many more than at
/// the next one, as a sensor at the end of its range has them; else 0.
std::size_t at_end_of_range(const SensorPair& pair) {
  constexpr std::size_t kFewest = 10, kMore = 5;
  std::vector<double> sorted = pair.measured;
  std::size_t stand = 0;
  for (int end = 0; end < 2; ++end) {
    std::ranges::sort(sorted);
    const auto alike = [&](double value) {
      return static_cast<std::size_t>(std::ranges::count(sorted, value));
    };
    const std::size_t first = alike(sorted.front());
    if (first < sorted.size() && first >= kFewest && first > kMore * alike(sorted[first]))
      stand += first;
    for (double& value : sorted) value = -value;
  }
  return stand;
}

/// The one flaw that explains most of what is left at a sensor.
struct MainFlaw {
  enum class Of { Nothing, Range, Factor, Delay, Drift, Spikes } of = Of::Nothing;
  double value = 0;
  double left = 0, before = 0;  ///< power over that of the signal, without the flaw and with it
};

MainFlaw main_flaw(const std::vector<SensorPair>& pairs) {
  constexpr double kLooked = 0.1;    // rms of the error over that of the signal, and more
  constexpr double kExplains = 0.3;  // of the power is left at most
  constexpr double kOfSignal = 0.5;  // likewise of the signal's, by a factor
  const double before = left_at(pairs);
  if (!(before > kLooked * kLooked)) return {};

  // What is seen of the sensor alone comes first.
  std::size_t stand = 0;
  for (const SensorPair& pair : pairs) stand += at_end_of_range(pair);
  if (stand > 0) return {MainFlaw::Of::Range, static_cast<double>(stand), before, before};

  MainFlaw main{.left = kExplains * before, .before = before};
  const auto ask = [&](MainFlaw::Of of, const Flaw& flaw) {
    if (flaw.left < main.left) main = {of, flaw.value, flaw.left, before};
  };
  // A factor near 0 takes the model away from any sensor, and leaves the signal.
  if (const Flaw factor = as_factor(pairs); factor.left < kOfSignal)
    ask(MainFlaw::Of::Factor, factor);
  ask(MainFlaw::Of::Delay, as_delay(pairs));
  ask(MainFlaw::Of::Drift, as_drift(pairs));
  ask(MainFlaw::Of::Spikes, as_spikes(pairs));
  return main;
}

/// In words; empty where there is none.
std::string flaw_of(const std::vector<SensorPair>& pairs) {
  const MainFlaw flaw = main_flaw(pairs);
  const std::string rest = format_number(100 * std::sqrt(flaw.left), 3) +
                           " % of its rms away, not " +
                           format_number(100 * std::sqrt(flaw.before), 3) + " %";
  const bool is_late = flaw.value > 0;
  switch (flaw.of) {
    case MainFlaw::Of::Nothing:
      return {};
    case MainFlaw::Of::Range:
      return format_number(flaw.value) +
             " samples stand at its greatest or least value: where it is at the end of its range, "
             "the plant goes on: leave it out, or record with a wider range";
    case MainFlaw::Of::Factor:
      return "shows " + format_number(flaw.value, 4) +
             " times what the model does, and with that is " + rest +
             (flaw.value < 0 ? ": does it count the other way round?" : ": is its unit right?");
    case MainFlaw::Of::Delay:
      return "comes " + format_number(1000 * std::abs(flaw.value), 3) +
             (is_late ? " ms later" : " ms earlier") + " than the model has it, and with that is " +
             rest +
             (is_late ? ": state its 'delay', or 'delay: unknown'"
                      : ": are the inputs late? 'delay: unknown' of each sensor finds it");
    case MainFlaw::Of::Drift:
      return "drifts, by up to " + format_number(100 * std::abs(flaw.value), 3) +
             " % of its rms over a recording, and without that is " + rest +
             ": take the drift off, or leave the sensor out";
    case MainFlaw::Of::Spikes:
      break;
  }
  return "has most of its error in " + format_number(flaw.value) +
         " samples, without which it is " + rest + ": has it spikes, or does the plant hit a stop?";
}

}  // namespace

std::vector<std::string> sensor_doubts(const InPlantSetup& setup,
                                       const std::vector<SensorFigures>& figures,
                                       const std::vector<InPlantTrace>& traces) {
  std::vector<std::string> doubts;
  std::string nearest;
  double least = INFINITY;
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    const std::string& channel = setup.sensors[s].channel;
    const std::vector<SensorPair> pairs = pairs_of(s, traces);
    const double away = std::sqrt(left_at(pairs));
    if (away < least) {
      least = away;
      nearest = channel;
    }
    if (const std::string flaw = flaw_of(pairs); !flaw.empty()) {
      doubts.push_back(channel + ": " + flaw);
      continue;
    }

    // Where no flaw tells it all, what is left may still be more than there was.
    for (const SensorFigures& figure : figures)
      if (figure.channel == channel && figure.training > figure.rms)
        doubts.push_back(
            figure.recording + ", " + channel + ": the model is " +
            format_number(100 * figure.training / figure.rms, 3) +
            " % of its rms away, further than from no motion at all: are its sign (a sensor that "
            "is met but for it is 200 % away), its unit, its time and what it measures right?");
  }
  // Intervals count what is left as chance, which so much is not.
  if (least > kFarAway)
    doubts.push_back("even " + nearest + ", the sensor that is met best, is " +
                     format_number(100 * least, 2) +
                     " % of its rms away: plant, law or recordings are others than stated, and "
                     "neither numbers nor intervals can be relied on; 'delay: unknown' of each "
                     "sensor finds an input that is late");
  return doubts;
}

bool is_far_off(const InPlantSetup& setup, const std::vector<InPlantTrace>& traces) {
  for (std::size_t s = 0; s < setup.sensors.size(); ++s)
    if (std::sqrt(left_at(pairs_of(s, traces))) <= kFarAway) return false;
  return true;
}

bool seems_late(const InPlantSetup& setup, const std::vector<InPlantTrace>& traces) {
  for (std::size_t s = 0; s < setup.sensors.size(); ++s)
    if (main_flaw(pairs_of(s, traces)).of == MainFlaw::Of::Delay) return true;
  return false;
}

std::vector<std::string> noise_doubts(const InPlantSetup& setup, const InPlantReport& report) {
  constexpr double kMuch = 0.3;  // of what the sensor shows
  std::vector<std::string> doubts;
  for (const PlantSensor& sensor : setup.sensors) {
    const auto found =
        std::ranges::find(report.nuisances, "noise of " + sensor.channel, &FittedParameter::name);
    if (found == report.nuisances.end()) continue;

    // Beside what the sensor shows; one that shows nothing has no share.
    double square = 0, recordings = 0;
    for (const SensorFigures& figure : report.sensors)
      if (figure.channel == sensor.channel) {
        square += figure.rms * figure.rms;
        recordings += 1;
      }
    const double share = found->value / std::sqrt(square / recordings);
    if (share > kMuch && std::isfinite(share))
      doubts.push_back(sensor.channel + ": its noise was found to be " +
                       format_number(found->value, 3) + ' ' + found->unit + ", " +
                       format_number(100 * share, 3) +
                       " % of what it shows: if it has not so much, its sign, its unit, its delay "
                       "('delay: unknown') or another sensor's are not as stated, and numbers and "
                       "intervals lean by it");
  }
  return doubts;
}

}  // namespace dashpot
