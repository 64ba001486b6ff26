#include "dashpot/machine/day_estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/machine/recording_parts.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/suspension/ground/road_profile.h"

namespace dashpot {
namespace {

constexpr double kDaySettles = 1;          // s, in which the filter settles
constexpr double kToldBlock = 1;           // s, of which what is told counts as one
constexpr std::size_t kTellStart = 500;    // samples that tell where a recording begins
constexpr double kPlantShare = 0.02;       // of a number of the plant: its size as an unknown
constexpr double kRoughnessFactor = 1.05;  // likewise
constexpr double kInputShare = 0.02;       // of a measured input, likewise
constexpr double kFlat = 4;  // of the misfit: where no step promises more, the search has ended

/// A day's recording as a function of the unknowns: amounts of wear, numbers of the plant beside
/// where they start, the logarithm of the roughness over its start; each in steps of its size.
class DayProblem {
 public:
  DayProblem(const WatchedPlant& watched, const PlantRecording& recording);

  std::size_t size() const { return size_; }
  /// Amounts of wear, the first of the unknowns.
  std::size_t amounts() const { return watched_->dampers.size() * watched_->wears.size(); }
  /// Samples that count as one of what is told.
  std::size_t block() const { return block_; }
  /// The samples that tell: where the plant moves, behind those in which the filter settles.
  const std::vector<std::size_t>& telling() const { return telling_; }
  /// Behind the unknowns may stand by how much each measured input is greater than it shows.
  Innovations at(const std::vector<double>& x) const {
    return innovations(observer(x), x.size() == size_ ? samples_ : with_inputs(x));
  }
  std::vector<std::string> inputs() const { return measured_inputs(watched_->setup); }
  /// The innovations' misfit, -2 log of their likelihood but for a constant; infinite where the
  /// filter diverges.
  double misfit_of(const Innovations& told) const;
  /// What the unknowns stand for.
  void describe(const std::vector<double>& x, const std::vector<double>& deviations,
                DayEstimate& day) const;
  /// The unknown that is the road's roughness.
  std::optional<std::size_t> road() const {
    return finds_road_ ? std::optional(size() - 1) : std::nullopt;
  }
  /// Mean of what that sensor shows, with its standard deviation.
  std::pair<double, double> level_of(const std::string& channel) const;

 private:
  PlantObserver observer(const std::vector<double>& x) const;
  ObservedSamples with_inputs(const std::vector<double>& x) const;
  double plant_value(std::size_t k, const std::vector<double>& x) const;
  double roughness(const std::vector<double>& x) const;
  double excitation(const std::vector<double>& x) const;

  const WatchedPlant* watched_;
  const PlantRecording* recording_;
  ObservedSamples samples_;
  ObserverScale scale_;
  std::size_t size_ = 0;       ///< unknowns
  std::vector<double> plant_;  ///< where unknown numbers of the plant start
  bool finds_road_ = false;
  std::size_t block_ = 1;
  std::vector<std::size_t> telling_;
};

DayProblem::DayProblem(const WatchedPlant& watched, const PlantRecording& recording)
    : watched_(&watched),
      recording_(&recording),
      samples_(observed_samples(watched.setup, recording)),
      scale_(observer_scale(watched.dampers)) {
  const InPlantSetup& setup = watched.setup;
  for (const PlantUnknown& unknown : setup.unknown) plant_.push_back(*unknown.about);
  for (const PlantInputChannel& input : setup.inputs)
    finds_road_ |= input.road && input.road->roughness == 0;
  size_ = amounts() + plant_.size() + (finds_road_ ? 1 : 0);
  block_ = std::max<std::size_t>(1, static_cast<std::size_t>(kToldBlock / recording.sample_time));
  const std::size_t settled =
      std::max(static_cast<std::size_t>(kDaySettles / recording.sample_time), samples_.count / 20);
  for (const auto& [first, end] : moving_stretches(setup, recording))
    for (std::size_t k = std::max(first, settled); k < end; ++k) telling_.push_back(k);

  // Means are no motion: a load or a zero moves them, and `level` tells of it.
  const std::size_t sensors = samples_.sensors;
  for (std::size_t s = 0; s < sensors; ++s) {
    const double mean = level_of(setup.sensors[s].channel).first;
    for (std::size_t k = 0; k < samples_.count; ++k) samples_.measured[k * sensors + s] -= mean;
    scale_.offset.push_back(std::max(setup.sensors[s].zero, watched.noise.sensors[s]));
  }
  const std::vector<double> nothing(size(), 0.0);
  std::vector<double> about = smoothed_start(observer(nothing), samples_, kTellStart);
  if (std::ranges::all_of(about, [](double x) { return std::isfinite(x); }))
    samples_.about = std::move(about);
}

double DayProblem::plant_value(std::size_t k, const std::vector<double>& x) const {
  const PlantUnknown& unknown = watched_->setup.unknown[k];
  const double share = kPlantShare * x[amounts() + k];
  return std::clamp(plant_[k] * (1 + share), unknown.lower, unknown.upper);
}

double DayProblem::roughness(const std::vector<double>& x) const {
  return watched_->noise.roughness * (finds_road_ ? std::pow(kRoughnessFactor, x[size_ - 1]) : 1);
}

double DayProblem::excitation(const std::vector<double>& x) const {
  if (inputs().empty()) return roughness(x);
  double square = 0;
  for (const double value : recording_->channel(inputs().front()).samples) square += value * value;
  return std::sqrt(square / static_cast<double>(samples_.count));
}

PlantObserver DayProblem::observer(const std::vector<double>& x) const {
  InPlantSetup setup = watched_->setup;
  setup.unknown.clear();
  for (std::size_t k = 0; k < plant_.size(); ++k)
    setup.known.emplace_back(watched_->setup.unknown[k].name, plant_value(k, x));
  ObserverNoise noise = watched_->noise;
  noise.roughness = roughness(x);
  noise.is_straight = true;  // as on the days before, whose state may be an old one
  std::vector<std::shared_ptr<const DamperModel>> dampers;
  for (std::size_t d = 0, at = 0; d < watched_->dampers.size(); ++d) {
    std::vector<WornDamper::Amount> amounts;
    for (const Wear* wear : watched_->wears) amounts.push_back({wear, wear->usual * x[at++]});
    dampers.push_back(std::make_shared<WornDamper>(watched_->dampers[d].model, std::move(amounts)));
  }
  return {observer_tables(setup, dampers, noise, scale_, recording_->sample_time, watched_->steps),
          dampers};
}

ObservedSamples DayProblem::with_inputs(const std::vector<double>& x) const {
  ObservedSamples moved = samples_;
  const std::size_t width = samples_.inputs + samples_.drives;
  for (std::size_t k = 0; k < samples_.count; ++k)
    for (std::size_t i = 0; i < samples_.inputs; ++i)
      moved.driven[k * width + i] *= 1 + kInputShare * x[size_ + i];
  return moved;
}

double DayProblem::misfit_of(const Innovations& told) const {
  if (told.beyond.empty()) return INFINITY;
  double sum = 0;
  for (const std::size_t sample : telling_)
    for (std::size_t k = sample * samples_.sensors; k < (sample + 1) * samples_.sensors; ++k)
      if (told.variance[k] > 0)
        sum += std::log(told.variance[k]) + told.beyond[k] * told.beyond[k] / told.variance[k];
  return std::isfinite(sum) ? sum : static_cast<double>(INFINITY);
}

void DayProblem::describe(const std::vector<double>& x, const std::vector<double>& deviations,
                          DayEstimate& day) const {
  for (std::size_t k = 0; k < amounts(); ++k) {
    const double usual = watched_->wears[k % watched_->wears.size()]->usual;
    day.wear.push_back(usual * x[k]);
    day.wear_deviation.push_back(usual * deviations[k]);
  }
  for (std::size_t k = 0; k < plant_.size(); ++k) {
    day.plant.push_back(plant_value(k, x));
    day.plant_deviation.push_back(kPlantShare * plant_[k] * deviations[amounts() + k]);
  }
  day.excitation = excitation(x);
  if (watched_->level.empty()) return;
  const auto [mean, deviation] = level_of(watched_->level);
  day.wear.push_back(mean);
  day.wear_deviation.push_back(deviation);
}

std::pair<double, double> DayProblem::level_of(const std::string& channel) const {
  const std::vector<double>& shown = recording_->channel(channel).samples;
  const std::size_t blocks = std::max<std::size_t>(2, shown.size() / block_),
                    length = shown.size() / blocks;
  const double mean =
      std::accumulate(shown.begin(), shown.end(), 0.0) / static_cast<double>(shown.size());
  double square = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto first = shown.begin() + static_cast<std::ptrdiff_t>(b * length);
    const double own = std::accumulate(first, first + static_cast<std::ptrdiff_t>(length), 0.0) /
                       static_cast<double>(length);
    square += (own - mean) * (own - mean);
  }
  const auto count = static_cast<double>(blocks);
  return {mean, std::sqrt(square / (count * (count - 1)))};
}

/// Slope and expected curvature of half the misfit, and what each block gives of the slope.
struct Scores {
  std::vector<double> information, slope;
  std::vector<std::vector<double>> blocks;
};

/// By forward differences of the innovations and of their variances, so long for each unknown.
std::optional<Scores> scores_at(const DayProblem& problem, const std::vector<double>& x,
                                const std::vector<double>& lengths, const Innovations& told,
                                std::size_t sensors) {
  const std::size_t n = x.size();
  std::vector<Innovations> beside;
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<double> moved = x;
    moved[k] += lengths[k];
    beside.push_back(problem.at(moved));
    if (beside.back().beyond.empty()) return std::nullopt;
  }

  Scores scores{std::vector<double>(n * n), std::vector<double>(n), {}};
  std::vector<double> by(n), by_variance(n);
  for (std::size_t row = 0; row < problem.telling().size() * sensors; ++row) {
    const std::size_t at = problem.telling()[row / sensors] * sensors + row % sensors;
    const double variance = told.variance[at], beyond = told.beyond[at];
    if (!(variance > 0)) continue;
    const std::size_t block = row / sensors / problem.block();
    if (block >= scores.blocks.size()) scores.blocks.emplace_back(n, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
      by[k] = (beside[k].beyond[at] - beyond) / (lengths[k] * std::sqrt(variance));
      by_variance[k] = (beside[k].variance[at] / variance - 1) / lengths[k];
      const double slope = by[k] * beyond / std::sqrt(variance) +
                           0.5 * by_variance[k] * (1 - beyond * beyond / variance);
      scores.slope[k] += slope;
      scores.blocks.back()[k] += slope;
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        scores.information[i * n + k] += by[i] * by[k] + 0.5 * by_variance[i] * by_variance[k];
  }
  return scores;
}

/// Standard deviations by what the blocks say of the slope, which the model's errors scatter more
/// than their information tells.
std::vector<double> deviations_of(const Scores& scores) {
  const std::size_t n = scores.slope.size();
  const auto blocks = static_cast<double>(scores.blocks.size());
  const std::vector<double> inverted = invert_symmetric(scores.information, n).inverse;
  std::vector<double> variance(n);
  for (const std::vector<double>& block : scores.blocks)
    for (std::size_t i = 0; i < n; ++i) {
      double own = 0;
      for (std::size_t k = 0; k < n; ++k)
        own += inverted[i * n + k] * (block[k] - scores.slope[k] / blocks);
      variance[i] += own * own * blocks / std::max(blocks - 1, 1.0);
    }
  for (double& one : variance) one = std::sqrt(one);
  return variance;
}

/// The rows and columns of a square matrix that `kept` names.
std::vector<double> part_of(const std::vector<double>& matrix, std::size_t n,
                            const std::vector<std::size_t>& kept) {
  std::vector<double> part;
  for (const std::size_t i : kept)
    for (const std::size_t k : kept) part.push_back(matrix[i * n + k]);
  return part;
}

/// The inverse of the information with its diagonal as unit, which also a singular one has: then
/// numbers are large, and none is left out.
std::vector<double> inverse_of_share(std::vector<double> information, std::size_t n) {
  constexpr double kTrace = 1e-9;
  std::vector<double> size(n);
  for (std::size_t i = 0; i < n; ++i) size[i] = std::sqrt(information[i * n + i]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      const double both = size[i] * size[k];
      information[i * n + k] = i == k ? 1 + kTrace : both > 0 ? information[i * n + k] / both : 0;
    }
  return inverse(information, n);
}

/// How well the day tells each amount of wear.
std::vector<WearOutlook> outlook_of(const Scores& scores, std::size_t dampers,
                                    const std::vector<const Wear*>& wears) {
  const std::size_t n = scores.slope.size(), amounts = dampers * wears.size();
  const std::vector<double> together = inverse_of_share(scores.information, n);
  std::vector<WearOutlook> outlook;
  for (std::size_t a = 0; a < amounts; ++a) {
    // All unknowns but the other dampers' amounts.
    const std::size_t first = a / wears.size() * wears.size(), last = first + wears.size();
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < n; ++i)
      if (i >= amounts || (i >= first && i < last)) kept.push_back(i);
    const std::size_t own = a - first;
    Scores some{part_of(scores.information, n, kept), {}, {}};
    for (const std::size_t i : kept) some.slope.push_back(scores.slope[i]);
    for (const std::vector<double>& block : scores.blocks) {
      some.blocks.emplace_back();
      for (const std::size_t i : kept) some.blocks.back().push_back(block[i]);
    }

    // Where these are unknown too, the deviation is as many times that.
    const std::vector<double> apart = inverse_of_share(some.information, kept.size());
    const double usual = wears[own]->usual,
                 alone = scores.information[a * n + a] > 0 ? usual * deviations_of(some)[own]
                                                           : static_cast<double>(INFINITY),
                 times = std::sqrt(together[a * n + a] / apart[own * kept.size() + own]);
    WearOutlook one{.deviation = alone * std::max(times, 1.0), .alone = alone};

    // The other damper's amount with which its estimate goes most.
    double most = -1;
    for (std::size_t b = 0; b < amounts; ++b) {
      const double goes = std::abs(together[a * n + b]) / std::sqrt(together[b * n + b]);
      if ((b >= first && b < last) || !(goes > most)) continue;
      most = goes;
      one.like = b;
    }
    outlook.push_back(one);
  }
  return outlook;
}

/// The search for the unknowns of a day. The misfit is rugged where the filter's tangents change,
/// so that differences are as long as the day leaves an unknown open, and short ones are tried
/// where these lead nowhere.
class DaySearch {
 public:
  DaySearch(const DayProblem& problem, std::size_t sensors)
      : problem_(&problem), sensors_(sensors), x_(problem.size()), lengths_(x_.size(), 1.0) {}

  /// Where all is as it is stated, the road as rough as is likely then. False where that diverges.
  bool begin() {
    if (!move_to(x_)) return false;
    const std::optional<std::size_t> road = problem_->road();
    for (const double factor : {4.0, 2.0, 1.5})
      for (const double side : {-1.0, 1.0})
        while (road && move_by(*road, side * std::log(factor) / std::log(kRoughnessFactor))) {
        }
    return true;
  }
  /// Steps of Newton's method by the expected curvature; how many.
  int run() {
    constexpr int kIterations = 15;
    constexpr double kNear = 0.01, kFine = 0.05;
    int iterations = 0;
    for (; iterations < kIterations; ++iterations) {
      scores_ = scores_at(*problem_, x_, lengths_, told_, sensors_);
      if (!scores_) return iterations;
      gain_ = step_by(*scores_);
      if (gain_ < kNear) break;
      if (moves_along()) continue;

      // Short differences, and the same scores as before for what the day leaves open.
      std::vector<double> fine = lengths_;
      for (double& length : fine) length *= kFine;
      const auto finer = scores_at(*problem_, x_, fine, told_, sensors_);
      if (!finer) break;
      const double before = gain_;
      gain_ = step_by(*finer);
      if (gain_ < kNear) break;
      if (moves_along()) continue;
      gain_ = std::min(gain_, before);
      break;
    }
    return iterations;
  }

  const std::vector<double>& x() const { return x_; }
  /// By how much each measured input would be greater if it were unknown too: the step of a search
  /// that goes on with it.
  std::vector<double> input_shares() const {
    std::vector<double> x = x_, lengths = lengths_;
    x.resize(x_.size() + problem_->inputs().size());
    lengths.resize(x.size(), 1.0);
    std::vector<double> shares(x.size() - x_.size());
    const auto scores = scores_at(*problem_, x, lengths, told_, sensors_);
    if (!scores) return shares;
    const std::size_t n = x.size();
    const std::vector<double> inverted = invert_symmetric(scores->information, n).inverse;
    for (std::size_t i = 0; i < shares.size(); ++i)
      for (std::size_t k = 0; k < n; ++k)
        shares[i] -= kInputShare * inverted[(x_.size() + i) * n + k] * scores->slope[k];
    return shares;
  }
  /// None where the search went astray.
  const std::optional<Scores>& scores() const { return scores_; }
  /// Of the misfit, by a further step; infinite where the search went astray.
  double gain() const { return scores_ ? gain_ : static_cast<double>(INFINITY); }

 private:
  bool move_to(const std::vector<double>& x) {
    Innovations there = problem_->at(x);
    const double misfit = problem_->misfit_of(there);
    if (!(misfit < misfit_)) return false;
    x_ = x;
    misfit_ = misfit;
    told_ = std::move(there);
    return true;
  }
  bool move_by(std::size_t unknown, double length) {
    std::vector<double> moved = x_;
    moved[unknown] += length;
    return move_to(moved);
  }
  /// Sets step and lengths; what the step would gain.
  double step_by(const Scores& scores) {
    constexpr double kShortest = 0.2;
    const std::size_t n = x_.size();
    const std::vector<double> inverted = invert_symmetric(scores.information, n).inverse;
    step_.assign(n, 0.0);
    double gain = 0;
    for (std::size_t i = 0; i < n; ++i) {
      lengths_[i] = std::clamp(std::sqrt(std::max(inverted[i * n + i], 0.0)), kShortest, 1.0);
      for (std::size_t k = 0; k < n; ++k) step_[i] -= inverted[i * n + k] * scores.slope[k];
      gain -= step_[i] * scores.slope[i];
    }
    return gain;
  }
  /// The step, half of it, and half again, until the misfit falls.
  bool moves_along() {
    constexpr int kHalvings = 4;
    for (int half = 0; half <= kHalvings; ++half) {
      std::vector<double> moved = x_;
      for (std::size_t k = 0; k < x_.size(); ++k) moved[k] += std::ldexp(step_[k], -half);
      if (move_to(moved)) return true;
    }
    return false;
  }

  const DayProblem* problem_;
  std::size_t sensors_;
  std::vector<double> x_, lengths_, step_;
  Innovations told_;
  double misfit_ = INFINITY, gain_ = INFINITY;
  std::optional<Scores> scores_;
};

/// What would be taken for a change of the damper, or for none, without a word.
void require_usable(const WatchedPlant& watched, const PlantRecording& recording) {
  // Something moves the plant, and all sensors show it.
  std::vector<std::string> channels = measured_inputs(watched.setup);
  for (const PlantSensor& sensor : watched.setup.sensors) channels.push_back(sensor.channel);
  for (const std::string& channel : channels) {
    const auto [low, high] = std::ranges::minmax(recording.channel(channel).samples);
    if (low == high)
      throw Error(recording.name + ", " + channel, "is constant",
                  "a day on which the plant moves and its sensors show it");
  }

  // As the days by which uncertainties were found.
  constexpr double kSame = 1e-6;
  if (watched.sample_time > 0 && std::abs(recording.sample_time / watched.sample_time - 1) > kSame)
    throw Error(recording.name,
                "is sampled every " + format_number(1e3 * recording.sample_time) +
                    " ms, the first days every " + format_number(1e3 * watched.sample_time) + " ms",
                "one rate on all days: at another one the same damper seems another");
  constexpr double kFewest = 3;  // s
  double moves = 0;
  for (const SampleRange& one : moving_stretches(watched.setup, recording))
    moves += recording.sample_time * static_cast<double>(one.length());
  const double lasts = recording.sample_time * static_cast<double>(recording.samples);
  if (moves < kDaySettles + kFewest - kSame)
    throw Error(recording.name,
                "is " + format_number(lasts) + " s long" +
                    (moves < lasts ? ", of which the plant moves " + format_number(moves) : ""),
                "3 s at least behind the first, and tens to tell of a damper");
}

}  // namespace

std::string at_an_end(const WatchedPlant& watched, const DayEstimate& day) {
  for (std::size_t k = 0; k < watched.setup.unknown.size(); ++k) {
    const PlantUnknown& unknown = watched.setup.unknown[k];
    if (day.plant[k] <= unknown.lower || day.plant[k] >= unknown.upper) return unknown.name;
  }
  return {};
}

DayEstimate estimate_day(const WatchedPlant& watched, const PlantRecording& recording,
                         std::vector<WearOutlook>* outlook) {
  require_usable(watched, recording);
  const DayProblem problem(watched, recording);
  DaySearch search(problem, watched.setup.sensors.size());
  DayEstimate day{.name = recording.name};
  if (search.begin()) day.iterations = search.run();
  if (!search.scores())
    throw Error(recording.name, "the filter diverges",
                "a damper and a plant that fit the recording");
  day.converged = search.gain() < kFlat;
  problem.describe(search.x(), deviations_of(*search.scores()), day);
  const std::vector<double> shares = search.input_shares();
  for (std::size_t i = 0; i < shares.size(); ++i)
    day.input_gains.emplace_back(problem.inputs()[i], 1 + shares[i]);
  if (outlook) *outlook = outlook_of(*search.scores(), watched.dampers.size(), watched.wears);
  if (!at_an_end(watched, day).empty()) day.converged = false;
  return day;
}

}  // namespace dashpot
