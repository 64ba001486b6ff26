#include "dashpot/damper/kinds/passive_network/train_passive_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "dashpot/base/random.h"
#include "dashpot/damper/nets/aligned.h"
#include "dashpot/damper/nets/flush_to_zero.h"

namespace dashpot {
namespace {

constexpr double kMostNorm = 1;  // of a gradient; a steeper one is shortened

/// The mean of a signal over `width` samples about each one.
std::vector<double> averaged(const std::vector<double>& signal, std::size_t width) {
  if (width < 2) return signal;
  const auto count = static_cast<std::ptrdiff_t>(signal.size());
  const auto reach = static_cast<std::ptrdiff_t>(width / 2);
  std::vector<double> sums(signal.size() + 1, 0.0), means(signal.size());
  std::partial_sum(signal.begin(), signal.end(), sums.begin() + 1);
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const auto first = std::max<std::ptrdiff_t>(0, k - reach), end = std::min(count, k + reach + 1);
    means[static_cast<std::size_t>(k)] =
        (sums[static_cast<std::size_t>(end)] - sums[static_cast<std::size_t>(first)]) /
        static_cast<double>(end - first);
  }
  return means;
}

/// One record as the kernel reads it.
struct Samples {
  std::vector<float> displacement, velocity, drive, force;
  std::size_t first = 0;
};

Samples standardised(const PassiveNetwork& n, const FreeRunRecord& record) {
  Samples samples;
  samples.first = record.first;
  const double gain = n.reads_displacement() ? 1 / n.displacement_scale : 0;
  for (const DamperInput& input : record.inputs) {
    samples.displacement.push_back(
        static_cast<float>((input.displacement - n.displacement_mean) * gain));
    samples.velocity.push_back(static_cast<float>(input.velocity / n.velocity_scale));
    samples.drive.push_back(static_cast<float>(input.current / n.drive_scale));
  }
  for (const double force : record.force)
    samples.force.push_back(static_cast<float>(force / n.force_scale));
  return samples;
}

double mean_of(const Samples& samples) {
  return std::accumulate(samples.force.begin(), samples.force.end(), 0.0) /
         static_cast<double>(samples.force.size());
}

/// Windows drawn from records, run and differentiated in blocks of as many as the processor has
/// lanes.
class WindowBatch {
 public:
  WindowBatch(const PassiveNetwork& network, const std::vector<const FreeRunRecord*>& records,
              const PassiveTrainOptions& options)
      : network_(network),
        options_(options),
        kernel_(passive_kernel(simd_levels().back())),
        numbers_(network.numbers.size()),
        gradient_(network.numbers.size()),
        room_(kernel_.room_for(network.sizes, options.window)) {
    for (const FreeRunRecord* record : records) samples_.push_back(standardised(network, *record));
    const std::size_t block = options.window * kernel_.lanes;
    for (AlignedVector<float>* signal :
         {&displacement_, &velocity_, &drive_, &force_, &weight_, &forces_})
      signal->resize(block);
  }

  const std::vector<Samples>& samples() const { return samples_; }
  const AlignedVector<float>& gradient() const { return gradient_; }
  const std::vector<double>& offset_gradient() const { return offset_gradient_; }
  /// Samples that were scored since the last call of clear().
  double scored() const { return scored_; }

  /// The sum of squared errors of an update's windows from anywhere, whose gradients are then
  /// known.
  double run(const std::vector<double>& numbers, const std::vector<double>& offsets,
             Random& random) {
    std::ranges::transform(numbers, numbers_.begin(),
                           [](double number) { return static_cast<float>(number); });
    std::ranges::fill(gradient_, 0.0f);
    offset_gradient_.assign(samples_.size(), 0.0);
    scored_ = 0;
    double squares = 0;
    for (std::size_t w = 0; w < options_.windows; w += kernel_.lanes)
      squares += block(offsets, random);
    return squares;
  }

 private:
  double block(const std::vector<double>& offsets, Random& random) {
    std::vector<std::size_t> chosen(kernel_.lanes);
    AlignedVector<float> lane_offsets(kernel_.lanes), lane_slopes(kernel_.lanes);
    AlignedVector<float> reading(kernel_.lanes);
    for (std::size_t lane = 0; lane < kernel_.lanes; ++lane) {
      chosen[lane] = random.index(samples_.size());
      lane_offsets[lane] = static_cast<float>(offsets[chosen[lane]]);
      fill(lane, samples_[chosen[lane]], random);
      const bool blind = options_.blind_share > 0 && random.uniform() < options_.blind_share;
      reading[lane] = blind ? 0.0f : 1.0f;
    }

    const PassiveWindows windows{
        .sizes = network_.sizes,
        .lags = network_.lags,
        .inert = network_.inert,
        .numbers = numbers_.data(),
        .step = static_cast<float>(network_.model_step),
        .samples = options_.window,
        .displacement = displacement_.data(),
        .velocity = velocity_.data(),
        .drive = drive_.data(),
        .force = force_.data(),
        .weight = weight_.data(),
        .reading = reading.data(),
        .drive_middle = static_cast<float>(0.5 * (network_.drive_low + network_.drive_high)),
        .offsets = lane_offsets.data(),
        .forces = forces_.data(),
        .gradient = gradient_.data(),
        .offset_gradient = lane_slopes.data(),
        .room = room_.data()};
    const double squares = kernel_.run(windows);
    for (std::size_t lane = 0; lane < kernel_.lanes; ++lane)
      offset_gradient_[chosen[lane]] += lane_slopes[lane];
    return squares;
  }

  /// A window from anywhere in a record, into one lane. Before the record's beginning its damper
  /// stands still; a short record's window ends in samples that do not count.
  void fill(std::size_t lane, const Samples& samples, Random& random) {
    const auto length = static_cast<std::ptrdiff_t>(samples.force.size());
    const auto run_in = static_cast<std::ptrdiff_t>(options_.run_in);
    const auto window = static_cast<std::ptrdiff_t>(options_.window);
    const auto places =
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, length + run_in - window));
    const auto start = static_cast<std::ptrdiff_t>(random.index(places)) - run_in;
    std::size_t at = lane;
    for (std::ptrdiff_t t = 0; t < window; ++t, at += kernel_.lanes) {
      const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(start + t, 0, length - 1));
      const bool within = start + t >= 0 && start + t < length;
      const bool counts = within && t >= run_in && k >= samples.first;
      displacement_[at] = samples.displacement[k];
      velocity_[at] = within ? samples.velocity[k] : 0.0f;
      drive_[at] = samples.drive[k];
      force_[at] = samples.force[k];
      weight_[at] = counts ? 1.0f : 0.0f;
      scored_ += counts ? 1 : 0;
    }
  }

  const PassiveNetwork& network_;
  const PassiveTrainOptions& options_;
  const PassiveKernel& kernel_;
  std::vector<Samples> samples_;
  AlignedVector<float> numbers_, gradient_, room_;
  AlignedVector<float> displacement_, velocity_, drive_, force_, weight_, forces_;
  std::vector<double> offset_gradient_;
  double scored_ = 0;
};

/// AdamW on what is searched: weights as they are, positive numbers by their logarithms, offsets.
class Descent {
 public:
  Descent(const PassiveNetwork& network, const PassiveTrainOptions& options, std::size_t records)
      : options_(options),
        first_positive_(PassiveLayout(network.sizes).first_positive()),
        inertia_rate_(PassiveLayout(network.sizes).inertia_rate),
        most_inertia_rate_(std::log(2 / network.model_step)),
        values_(network.numbers),
        decay_(network.numbers.size(), 0.0),
        mean_(network.numbers.size() + records, 0.0),
        square_(mean_.size(), 0.0) {
    for (std::size_t k = first_positive_; k < values_.size(); ++k)
      values_[k] = std::log(std::max(values_[k], 1e-30));
    set_decays(network.sizes);
  }

  /// Moves numbers and offsets against their gradients, which are of a mean square.
  void step(std::size_t update, std::vector<double>& numbers, std::vector<double>& offsets,
            std::vector<double> gradient, const std::vector<double>& offset_gradient) {
    const std::size_t count = values_.size();
    for (std::size_t k = first_positive_; k < count; ++k) gradient[k] *= numbers[k];
    const double norm =
        std::sqrt(std::inner_product(gradient.begin(), gradient.end(), gradient.begin(), 0.0));
    const double shorter = norm > kMostNorm ? kMostNorm / norm : 1;

    const double share = static_cast<double>(update) / static_cast<double>(options_.updates);
    const double rate =
        kLeastRate + (options_.rate - kLeastRate) / 2 * (1 + std::cos(std::numbers::pi * share));
    kept_mean_ *= kMean;
    kept_square_ *= kSquare;
    const auto move = [&](std::size_t k, double slope) {
      mean_[k] = kMean * mean_[k] + (1 - kMean) * slope;
      square_[k] = kSquare * square_[k] + (1 - kSquare) * slope * slope;
      return rate * mean_[k] / (1 - kept_mean_) /
             (std::sqrt(square_[k] / (1 - kept_square_)) + kTiny);
    };
    for (std::size_t k = 0; k < count; ++k) {
      values_[k] -= rate * decay_[k] * values_[k] + move(k, gradient[k] * shorter);
      if (k == inertia_rate_) values_[k] = std::min(values_[k], most_inertia_rate_);
      numbers[k] = k < first_positive_ ? values_[k] : std::exp(values_[k]);
    }
    if (!options_.offsets) return;
    for (std::size_t r = 0; r < offsets.size(); ++r)
      offsets[r] -= move(count + r, offset_gradient[r]);
  }

 private:
  static constexpr double kMean = 0.9, kSquare = 0.99, kTiny = 1e-8, kLeastRate = 1e-5;

  /// Weights on what networks see shrink as much as asked.
  void set_decays(const PassiveSizes& sizes) {
    const PassiveLayout at(sizes);
    const auto shrink = [&](std::size_t first, std::size_t end) {
      std::fill_n(decay_.begin() + static_cast<std::ptrdiff_t>(first), end - first,
                  options_.weight_decay);
    };
    shrink(at.weights, at.gates);
    shrink(at.viscous_weights, at.viscous);
  }

  const PassiveTrainOptions& options_;
  const std::size_t first_positive_, inertia_rate_;
  const double
      most_inertia_rate_;  ///< its logarithm: a step cannot tell what is quicker than itself
  std::vector<double> values_, decay_, mean_, square_;
  double kept_mean_ = 1, kept_square_ = 1;
};

/// A network without an offset of its own starts with each record's mean force as its offset.
std::vector<double> starting_offsets(const std::vector<Samples>& samples, bool free) {
  std::vector<double> offsets(samples.size(), 0.0);
  if (free) std::ranges::transform(samples, offsets.begin(), mean_of);
  return offsets;
}

/// Forces of a network in free run on a record's motion, made so many times slower, from the first
/// scored sample on.
std::vector<double> free_run(const PassiveNetwork& network, const FreeRunRecord& record,
                             double slower = 1) {
  const auto input_at = [&](std::size_t k) {
    DamperInput input = record.inputs[k];
    input.velocity /= slower;
    return input;
  };
  std::vector<double> state(network.size()), forces;
  forces.reserve(record.inputs.size() - record.first);
  network.rest(input_at(0), state);
  for (std::size_t k = 0; k < record.inputs.size(); ++k) {
    if (k > 0)
      network.advance(input_at(k - 1), input_at(k), slower * (record.time[k] - record.time[k - 1]),
                      state);
    if (k >= record.first) forces.push_back(network.force(input_at(k), state));
  }
  return forces;
}

/// The root mean square of a difference.
double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double squares = 0;
  for (std::size_t k = 0; k < a.size(); ++k) squares += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(squares / static_cast<double>(a.size()));
}

}  // namespace

std::vector<FreeRunRecord> at_step(const std::vector<const FreeRunRecord*>& records, double step) {
  std::vector<FreeRunRecord> all;
  for (const FreeRunRecord* record : records) {
    const double begin = record->time.front(), duration = record->time.back() - begin;
    const double own = duration / static_cast<double>(record->time.size() - 1);
    const auto width = static_cast<std::size_t>(std::max(1.0, std::round(step / own)));

    // Each channel averaged, then read between its samples.
    const auto channel = [&](auto of) {
      std::vector<double> values;
      for (const DamperInput& input : record->inputs) values.push_back(of(input));
      return averaged(values, width);
    };
    const std::vector<double> x = channel([](auto& i) { return i.displacement; });
    const std::vector<double> v = channel([](auto& i) { return i.velocity; });
    const std::vector<double> u = channel([](auto& i) { return i.current; });
    const std::vector<double> f = averaged(record->force, width);

    FreeRunRecord coarse;
    const double first_scored = record->time[record->first];
    const auto count = static_cast<std::size_t>(duration / step) + 1;
    for (std::size_t k = 0; k < count; ++k) {
      const double time = begin + static_cast<double>(k) * step;
      const double place = (time - begin) / own;
      const auto low = std::min(static_cast<std::size_t>(place), record->time.size() - 2);
      const double share = place - static_cast<double>(low);
      const auto read = [&](const std::vector<double>& values) {
        return values[low] + (values[low + 1] - values[low]) * share;
      };
      coarse.inputs.push_back({read(x), read(v), read(u)});
      coarse.time.push_back(time);
      coarse.force.push_back(read(f));
      if (time < first_scored) coarse.first = k + 1;
    }
    coarse.first = std::min(coarse.first, count - 1);
    all.push_back(std::move(coarse));
  }
  return all;
}

void initialise(PassiveNetwork& network, std::uint64_t seed) {
  const PassiveSizes& z = network.sizes;
  const PassiveLayout at(z);
  Random random(seed);
  network.numbers.assign(at.count, 0.0);
  double* const numbers = network.numbers.data();

  // Neurons: forces of springs by a normal distribution, all else within the reach of what is seen.
  const double seen_reach = 1 / std::sqrt(static_cast<double>(z.seen()));
  for (std::size_t j = 0; j < z.neurons + z.memories; ++j)
    for (std::size_t i = 0; i < z.inputs(); ++i) {
      const bool spring = i >= z.seen() && i + 1 < z.inputs();
      numbers[at.weights + j * z.inputs() + i] =
          spring ? 0.3 * random.normal() : seen_reach * random.uniform(-1, 1);
    }
  const double viscous_reach = 1 / std::sqrt(static_cast<double>(z.seen() + 1));
  for (std::size_t k = at.viscous_weights; k < at.viscous; ++k)
    numbers[k] = viscous_reach * random.uniform(-1, 1);
  for (std::size_t k = 0; k < z.viscous_neurons; ++k)
    numbers[at.viscous + k] =
        random.uniform(-1, 1) / std::sqrt(static_cast<double>(z.viscous_neurons));
  numbers[at.viscous + z.viscous_neurons] = -2;

  // Gates: springs relax slowly in time and yield on the way.
  constexpr double kByTime = -3, kByWay = 1;
  for (std::size_t k = 0; k < 2 * z.springs; ++k) {
    double* const row = numbers + at.gates + k * (z.neurons + 2);
    for (std::size_t j = 0; j < z.neurons; ++j) row[j] = 0.3 * random.normal();
    row[z.neurons] = k < z.springs ? kByTime : kByWay;
  }

  // Stiffness from soft to stiff.
  constexpr double kSoft = 2.5, kStiff = 250;  // 1/s
  for (std::size_t k = 0; k < z.springs; ++k) {
    const double share =
        z.springs > 1 ? static_cast<double>(k) / static_cast<double>(z.springs - 1) : 0.5;
    numbers[at.stiffness + k] = kSoft * std::pow(kStiff / kSoft, share);
    numbers[at.levers + k] = std::exp(-0.5);
    numbers[at.levers + z.springs + k] = 0.5;
  }

  // Memories from slow to fast, and the numbers that stand alone.
  constexpr double kSlow = 5, kFast = 200;  // 1/s
  for (std::size_t k = 0; k < z.memories; ++k)
    numbers[at.memory_rates + k] =
        kSlow * std::pow(kFast / kSlow, z.memories > 1 ? static_cast<double>(k) /
                                                             static_cast<double>(z.memories - 1)
                                                       : 0.5);
  numbers[at.saturation] = 2;
  const double potential[] = {0.02, 0.007, 0.4, 0.007, 0.4};
  std::ranges::copy(potential, numbers + at.potential);
  numbers[at.drive_rate] = 200;
  numbers[at.inertia] = 0.18;
  numbers[at.inertia_rate] = 200;
}

FreeRunTrainReport train(PassiveNetwork& network, const std::vector<const FreeRunRecord*>& records,
                         const PassiveTrainOptions& options) {
  const FlushToZero flush;
  WindowBatch batch(network, records, options);
  std::vector<double> offsets = starting_offsets(batch.samples(), options.offsets);
  Descent descent(network, options, records.size());
  Random random(options.seed);

  double mean_square = 0;
  constexpr double kMemory = 0.98;  // of the mean square that is reported
  for (std::size_t update = 0; update < options.updates; ++update) {
    const double squares = batch.run(network.numbers, offsets, random);
    const double scored = std::max(1.0, batch.scored());
    mean_square =
        update == 0 ? squares / scored : kMemory * mean_square + (1 - kMemory) * squares / scored;
    std::vector<double> gradient(batch.gradient().begin(), batch.gradient().end());
    std::vector<double> offset_gradient = batch.offset_gradient();
    for (double& slope : gradient) slope /= scored;
    for (double& slope : offset_gradient) slope /= scored;
    descent.step(update, network.numbers, offsets, std::move(gradient), offset_gradient);
    if (options.on_update) options.on_update();
  }
  return {.converged = true,
          .iterations = static_cast<int>(options.updates),
          .rmse = std::sqrt(mean_square) * network.force_scale};
}

FreeRunCost passive_cost(const PassiveNetwork& network,
                         const std::vector<const FreeRunRecord*>& records,
                         const PassiveTrainOptions& options) {
  WindowBatch batch(network, records, options);
  Random random(options.seed);
  const double squares =
      batch.run(network.numbers, starting_offsets(batch.samples(), options.offsets), random);
  return {squares, std::vector<double>(batch.gradient().begin(), batch.gradient().end())};
}

std::vector<std::size_t> stray_members(const std::vector<PassiveNetwork>& networks,
                                       const std::vector<const FreeRunRecord*>& records) {
  constexpr std::array kSlower{2.0, 0.5};
  constexpr double kTimes = 5, kShare = 0.05;
  const std::size_t count = networks.size();
  if (count < 3) return {};

  // Their forces on all motions, each less its mean as records are judged.
  std::vector<std::vector<double>> forces(count);
  for (std::size_t k = 0; k < count; ++k)
    for (const FreeRunRecord* record : records)
      for (const double slower : kSlower) {
        const std::vector<double> run = free_run(networks[k], *record, slower);
        const double mean =
            std::accumulate(run.begin(), run.end(), 0.0) / static_cast<double>(run.size());
        for (const double force : run) forces[k].push_back(force - mean);
      }

  // How far each is from the nearest other, and what is usual among them.
  std::vector<double> nearest(count, INFINITY);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j)
      if (i != j) nearest[i] = std::min(nearest[i], distance(forces[i], forces[j]));
  std::vector<double> sorted = nearest;
  std::ranges::sort(sorted);
  const double most = std::max(kTimes * sorted[count / 2], kShare * networks.front().force_scale);

  std::vector<std::size_t> strays;
  for (std::size_t k = 0; k < count; ++k)
    if (nearest[k] > most) strays.push_back(k);
  return strays;
}

double squares_left(const PassiveNetwork& network, const FreeRunRecord& record, bool offset) {
  const std::vector<double> run = free_run(network, record);
  double sum = 0, squares = 0;
  for (std::size_t k = 0; k < run.size(); ++k) {
    const double error = run[k] - record.force[record.first + k];
    sum += error;
    squares += error * error;
  }
  const auto scored = static_cast<double>(run.size());
  return offset ? squares - sum * sum / scored : squares;
}

}  // namespace dashpot
