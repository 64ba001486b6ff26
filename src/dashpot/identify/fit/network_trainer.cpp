#include "dashpot/identify/fit/network_trainer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/nets/normal_equations.h"
#include "dashpot/damper/nets/train_batches.h"
#include "dashpot/damper/nets/train_lbfgs.h"
#include "dashpot/identify/fit/network_design.h"
#include "dashpot/record/trial_parts.h"
#include "dashpot/split.h"

namespace dashpot {
namespace {

constexpr std::array kNetworkDecays{1e-2, 1e-3, 3e-4, 1e-4, 1e-5};
constexpr std::size_t kNetworkTrialSamples = 2500;
constexpr std::size_t kTrialStarts = 2;
constexpr int kBatchEpochs = 100;

Optimiser optimiser_of(Trainer trainer) {
  switch (trainer) {
    case Trainer::Momentum:
      return Optimiser::Momentum;
    case Trainer::RmsProp:
      return Optimiser::RmsProp;
    case Trainer::Adam:
      return Optimiser::Adam;
    case Trainer::AdamW:
      return Optimiser::AdamW;
    default:
      return Optimiser::Sgd;
  }
}

/// The samples that a training learns from, and those that stop it.
struct Lesson {
  TrainingSamples samples, held_back;  ///< nothing held back: no early stopping
};

/// Every k-th sample, so that about `most` are left.
TrainingSamples thinned(const TrainingSamples& all, std::size_t inputs, std::size_t most) {
  const std::size_t count = all.targets.size(), stride = (count + most - 1) / most;
  TrainingSamples some;
  some.groups = all.groups;
  for (std::size_t s = 0; s < count; s += stride) {
    const auto row = all.inputs.begin() + static_cast<std::ptrdiff_t>(s * inputs);
    some.inputs.insert(some.inputs.end(), row, row + static_cast<std::ptrdiff_t>(inputs));
    some.targets.push_back(all.targets[s]);
    if (!all.group.empty()) some.group.push_back(all.group[s]);
  }
  return some;
}

/// The samples less the offsets that Levenberg-Marquardt finds for their groups beside a small
/// network. Steps on mini-batches cannot eliminate offsets: left free they take the current's
/// effect away from a network that has yet to learn it, and released late they come too late.
TrainingSamples without_offsets(TrainingSamples samples, const Mlp& start,
                                const IdentifyOptions& options) {
  if (samples.group.empty()) return samples;
  constexpr std::size_t kNeurons = 10;

  // A network of few neurons, trained beside the offsets on a part of the samples.
  Mlp beside = start;
  beside.layers = {start.layers.front(), kNeurons, 1};
  beside.activations.clear();
  initialise(beside, options.seed);
  TrainOptions how{.threads = options.threads};
  how.on_iteration = [&](int, double) { options.monitor.check(); };
  const TrainReport found =
      train(beside, thinned(samples, start.layers.front(), kNetworkTrialSamples), how);

  // Take the offsets that it found out of all samples, which then need no groups.
  for (std::size_t s = 0; s < samples.targets.size(); ++s)
    samples.targets[s] -= found.offsets[samples.group[s]];
  samples.group.clear();
  samples.groups = 0;
  return samples;
}

/// One training as the design says.
class Training {
 public:
  Training(const IdentifyOptions& options, double decay) : options_(options), decay_(decay) {}

  /// is_watched: how its error falls is reported; of several at once only one is.
  TrainReport run(Mlp& mlp, const Lesson& lesson, std::uint64_t seed,
                  bool is_watched = false) const {
    const NetworkDesign& design = options_.network;
    const Trainer trainer = design.trainer.value_or(Trainer::LevenbergMarquardt);

    const auto follow = [this, is_watched](int, double rmse) {
      is_watched ? options_.monitor.report_cost(rmse * rmse) : options_.monitor.check();
    };

    // Early stopping, where something is held back.
    Stopping stopping;
    if (!lesson.held_back.targets.empty())
      stopping = {&lesson.held_back, static_cast<int>(*design.patience)};

    // The trainer that the design names, with its own options.
    if (trains_on_batches(trainer)) return on_batches(mlp, lesson.samples, stopping, seed, follow);
    if (trainer == Trainer::Lbfgs) {
      LbfgsOptions how{.weight_decay = decay_, .threads = options_.threads, .stopping = stopping};
      if (design.epochs) how.max_iterations = static_cast<int>(*design.epochs);
      how.on_iteration = follow;
      return train_lbfgs(mlp, lesson.samples, how);
    }

    TrainOptions how{.weight_decay = decay_,
                     .threads = options_.threads,
                     .bayesian = trainer == Trainer::Bayesian,
                     .stopping = stopping};
    if (design.epochs) how.max_iterations = static_cast<int>(*design.epochs);
    how.on_iteration = follow;
    return train(mlp, lesson.samples, how);
  }

 private:
  TrainReport on_batches(Mlp& mlp, const TrainingSamples& samples, const Stopping& stopping,
                         std::uint64_t seed, const std::function<void(int, double)>& follow) const {
    const NetworkDesign& design = options_.network;
    BatchTrainOptions how{
        .optimiser = optimiser_of(*design.trainer), .seed = seed, .stopping = stopping};
    how.epochs = design.epochs ? static_cast<int>(*design.epochs) : kBatchEpochs;
    how.schedule.kind = design.schedule.value_or(RateSchedule::Cosine);
    how.schedule.step_epochs = how.epochs / 3.0;
    how.rate = design.rate.value_or(how.rate);
    how.batch = design.batch.value_or(how.batch);
    how.l1 = design.l1.value_or(0);
    // The decay is that of |w|^2, whose slope is 2 w.
    (how.optimiser == Optimiser::AdamW ? how.decay : how.l2) = 2 * decay_;
    how.on_epoch = follow;
    TrainReport report = train_batches(mlp, samples, how);
    report.converged = !report.stopped_early;
    return report;
  }

  const IdentifyOptions& options_;
  double decay_;
};

/// Finds the weight decay with which trials predict best what was held back from them.
class DecayTrials {
 public:
  DecayTrials(const Mlp& start, const std::vector<Record>& training, const SamplesOf& samples_of,
              const IdentifyOptions& options)
      : start_(start), options_(options) {
    for (const Fold& fold : trial_folds(training))
      lessons_.push_back(
          {thinned(samples_of(fold.training), start.layers.front(), kNetworkTrialSamples),
           thinned(samples_of(fold.left_out), start.layers.front(), kNetworkTrialSamples)});
  }

  double best() const {
    std::vector<double> errors(kNetworkDecays.size() * lessons_.size() * kTrialStarts);
    parallel_for(errors.size(), options_.threads, [&](std::size_t k) {
      errors[k] = error(kNetworkDecays[k % kNetworkDecays.size()], k / kNetworkDecays.size());
    });
    std::array<double, kNetworkDecays.size()> sums{};
    for (std::size_t k = 0; k < errors.size(); ++k) sums[k % kNetworkDecays.size()] += errors[k];
    return kNetworkDecays[static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) -
                                                   sums.begin())];
  }

 private:
  /// Squared error on what was held back, per record with its best offset.
  double error(double decay, std::size_t trial) const {
    const Lesson& lesson = lessons_[trial / kTrialStarts];
    Mlp mlp = start_;
    const std::uint64_t seed = options_.seed + trial % kTrialStarts;
    initialise(mlp, seed);
    Training(options_, decay).run(mlp, {lesson.samples, {}}, seed);
    const SampleBlocks blocks = make_blocks(mlp, lesson.held_back, TrainOptions().offset_decay);
    return BlockErrors(mlp, blocks, 1).squared_error(mlp.parameters);
  }

  const Mlp& start_;
  const IdentifyOptions& options_;
  std::vector<Lesson> lessons_;
};

double weight_decay(const Mlp& start, const std::vector<Record>& training,
                    const SamplesOf& samples_of, const IdentifyOptions& options) {
  const Trainer trainer = options.network.trainer.value_or(Trainer::LevenbergMarquardt);
  if (options.network.l2) return *options.network.l2;
  if (trains_on_batches(trainer)) return 0;
  if (trainer == Trainer::Bayesian) return TrainOptions().weight_decay;  // where its search begins
  return DecayTrials(start, training, samples_of, options).best();
}

/// One lesson for all members, or one for each way of holding records back.
std::vector<Lesson> lessons_of(const Mlp& start, const std::vector<Record>& training,
                               const SamplesOf& samples_of, const IdentifyOptions& options) {
  const NetworkDesign& design = options.network;
  const bool batches = design.trainer && trains_on_batches(*design.trainer);
  const auto learnt = [&](const std::vector<Record>& records) {
    return batches ? without_offsets(samples_of(records), start, options) : samples_of(records);
  };
  if (design.patience.value_or(0) == 0) return {{learnt(training), {}}};
  std::vector<Lesson> lessons;
  for (const Fold& fold : trial_folds(training)) {
    if (lessons.size() == design.members.value_or(1)) break;
    lessons.push_back({learnt(fold.training), samples_of(fold.left_out)});
  }
  return lessons;
}

void add_member(TrainedEnsemble& ensemble, const TrainedMlp& best) {
  ensemble.members.push_back(best.mlp);
  ensemble.iterations = std::max(ensemble.iterations, best.report.iterations);
  ensemble.rmse += best.report.rmse;
}

}  // namespace

TrainedEnsemble train_networks(const Mlp& start, const std::vector<Record>& training,
                               const SamplesOf& samples_of, const IdentifyOptions& options) {
  require_trainer(options.network);
  const Training one(options, weight_decay(start, training, samples_of, options));
  const std::vector<Lesson> lessons = lessons_of(start, training, samples_of, options);
  const std::size_t members = options.network.members.value_or(1);
  const auto starts = static_cast<std::size_t>(std::max(1, options.starts));
  std::vector<TrainedMlp> trained = train_from_starts(
      start, members * starts, options.seed, options.threads, [&](Mlp& mlp, std::size_t k) {
        return one.run(mlp, lessons[k / starts % lessons.size()], options.seed + k, k == 0);
      });

  TrainedEnsemble ensemble;
  bool ended = true;
  for (std::size_t member = 0; member < members; ++member) {
    const TrainedMlp& best = best_of(std::span(trained).subspan(member * starts, starts));
    add_member(ensemble, best);
    ended = ended && (best.report.converged || best.report.stopped_early);
  }
  ensemble.rmse /= static_cast<double>(members);
  if (!std::isfinite(ensemble.rmse)) {
    ensemble.message =
        "the training went to infinity: a smaller rate, more starts or fewer members may help";
    return ensemble;
  }
  ensemble.status = ended ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
  ensemble.message = ended ? "converged" : "iteration limit reached";
  return ensemble;
}

}  // namespace dashpot
