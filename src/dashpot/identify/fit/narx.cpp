#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/kinds/narx/narx_model.h"
#include "dashpot/damper/kinds/narx/presets.h"
#include "dashpot/damper/kinds/narx/train_narx.h"
#include "dashpot/damper/nets/ensemble.h"
#include "dashpot/damper/nets/standardise.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/member_report.h"
#include "dashpot/record/time_base.h"
#include "dashpot/record/trial_parts.h"
#include "dashpot/split.h"

namespace dashpot {
namespace {

// Rows of regressors at most; finer records give some of the grids that lie in them.
constexpr std::size_t kMostRows = 6000;
constexpr std::array kNarxDecays{1e-2, 1e-3, 1e-4, 1e-5};
constexpr std::size_t kMostTrials = 4, kTrialRows = 2000;  // of decays
constexpr int kFirstIterations = 40;  // series-parallel, where free run follows
// s: a step of the network is as many samples as fit in, unless the design states them. At shorter
// steps the fed-back force all but repeats itself, and whole records take so many more of them.
constexpr double kUsualStep = 1e-3;

/// A preset with what the user's design changes of it.
struct NarxPlan {
  NarxPlan(const NarxPreset& preset, const NetworkDesign& design)
      : name(preset.name),
        inputs(preset.inputs),
        hidden(design.hidden.empty() ? preset.hidden : design.hidden),
        activation(design.activation.value_or(Activation::Tanh)),
        delays(design.delays.value_or(preset.delays)),
        feedback(design.feedback.value_or(preset.feedback)),
        spacing(design.spacing),
        members(design.members.value_or(1)),
        training(design.training.value_or(FeedbackTraining::FreeRun)),
        window(design.window.value_or(0)),
        bounded(design.output.value_or(OutputRange::Linear) == OutputRange::Bounded) {
    const Trainer trainer = design.trainer.value_or(Trainer::LevenbergMarquardt);
    if (trainer != Trainer::LevenbergMarquardt && trainer != Trainer::Lbfgs)
      throw Error("--network trainer", "a network that reads its past cannot be trained so",
                  "lm or lbfgs");
    through_time = trainer == Trainer::Lbfgs;
  }

  std::string name;
  std::vector<std::string> inputs;
  std::vector<std::size_t> hidden;
  Activation activation;
  std::size_t delays, feedback;
  std::optional<std::size_t> spacing;
  std::size_t members;
  FeedbackTraining training;
  std::size_t window;
  bool bounded, through_time = false;
};

double step_of(const Record& record) {
  if (record.sample_time > 0) return record.sample_time;
  return (record.time.back() - record.time.front()) / static_cast<double>(record.size() - 1);
}

/// A drive that is steady in each record has no past worth reading.
Regressors regressors_of(const NarxPlan& plan, const std::vector<Record>& training,
                         DriveUnit drive_unit) {
  double step = 0;
  for (const Record& record : training) step = std::max(step, step_of(record));
  const double samples_per_step = plan.spacing
                                      ? static_cast<double>(*plan.spacing)
                                      : std::max(1.0, std::floor(kUsualStep / step * (1 + 1e-9)));
  Regressors regressors =
      Regressors::of(plan.inputs, plan.delays, plan.feedback, samples_per_step * step);
  if (!drive_range(training, drive_unit).varies)
    for (Regressors::Input& input : regressors.inputs)
      if (input.name == "current") input.lags = {0};
  return regressors;
}

/// Records on the network's own grid.
class NarxData {
 public:
  /// Finer records give some of the grids that lie in them: every so many-th sample, from several
  /// first ones on. Long records give some of their parts, so that there are about `most` rows.
  NarxData(Regressors of, const std::vector<Record>& records, DriveUnit drive_unit,
           std::size_t most)
      : regressors(std::move(of)) {
    // So many grids of one record give about the rows wanted.
    double seconds = 0;
    for (const Record& record : records) seconds += record.time.back() - record.time.front();
    const auto most_grids = static_cast<std::size_t>(
        std::max(1.0, static_cast<double>(most) * regressors.sample_time / seconds));

    // From each record the grids that lie in it, their first samples spread evenly.
    samples.feedback = regressors.feedback;
    samples.rows.groups = records.size();
    for (std::size_t r = 0; r < records.size(); ++r) {
      const auto grids = static_cast<std::size_t>(
          std::max(1.0, std::round(regressors.sample_time / step_of(records[r]))));
      const std::size_t taken = std::min(grids, most_grids);
      for (std::size_t k = 0; k < taken; ++k) add(records[r], r, k * grids / taken, drive_unit);
    }

    // Records too short give no row; where still too many are left, parts of each stretch go.
    if (samples.rows.targets.empty())
      throw Error(records.front().name, "no record is longer than the network's past",
                  "fewer delays, or a smaller spacing");
    if (samples.rows.targets.size() > most) thin((samples.rows.targets.size() + most - 1) / most);
  }

  /// Takes what the records' force zeros differ by out of the forces, the fed-back ones too.
  void remove(const std::vector<double>& offsets) {
    const std::size_t width = regressors.count();
    for (std::size_t row = 0; row < samples.rows.targets.size(); ++row) {
      const double offset = offsets[samples.rows.group[row]];
      samples.rows.targets[row] -= offset;
      for (std::size_t k = regressors.input_count(); k < width; ++k)
        samples.rows.inputs[row * width + k] -= offset;
    }
  }

  Regressors regressors;
  NarxSamples samples;

 private:
  /// Keeps the first part of each stretch and every so many-th one behind it: they begin with
  /// measured forces.
  void thin(std::size_t every) {
    constexpr std::size_t kPart = 200;

    const NarxSamples all = std::exchange(samples, {});
    const std::size_t width = regressors.count(), count = all.rows.targets.size();
    samples.feedback = all.feedback;
    samples.rows.groups = all.rows.groups;

    // Copy one part of every `every` in each stretch as a stretch of its own.
    for (std::size_t k = 0; k < all.stretches.size(); ++k) {
      const std::size_t end = k + 1 < all.stretches.size() ? all.stretches[k + 1] : count;
      for (std::size_t at = all.stretches[k]; at < end; at += every * kPart) {
        const std::size_t last = std::min(at + kPart, end);
        samples.stretches.push_back(samples.rows.targets.size());
        const auto copy = [&](auto& to, const auto& from, std::size_t size) {
          const auto begin = from.begin();
          to.insert(to.end(), begin + static_cast<std::ptrdiff_t>(at * size),
                    begin + static_cast<std::ptrdiff_t>(last * size));
        };
        copy(samples.rows.inputs, all.rows.inputs, width);
        copy(samples.rows.targets, all.rows.targets, 1);
        copy(samples.rows.group, all.rows.group, 1);
      }
    }
  }

  void add(const Record& record, std::size_t group, std::size_t first, DriveUnit drive_unit) {
    // A record shorter than the network's past gives nothing.
    const double step = regressors.sample_time;
    if (record.time.back() - record.time[first] <
        step * static_cast<double>(regressors.depth() + 2))
      return;

    // Bring the rest of the record onto the network's grid, and build its rows of regressors.
    Record grid = record.slice(first, record.size());
    const double warm_up = record.time[record.warm_up] - record.time[first];
    if (step != record.sample_time) resample(grid, 1 / step);
    const std::vector<double>& force = grid.channel("force").samples;
    std::vector<double> rows = regressor_rows(regressors, damper_inputs(grid, drive_unit), force);

    // Score from where both the past is known and the warm-up has ended.
    const std::size_t past = regressors.depth(), width = regressors.count();
    const auto scored = static_cast<std::size_t>(std::max(0.0, std::ceil(warm_up / step - 1e-6)));
    const std::size_t from = std::max(past, scored);
    if (from >= force.size()) return;

    // Append rows and targets as a new stretch.
    TrainingSamples& to = samples.rows;
    samples.stretches.push_back(to.targets.size());
    to.inputs.insert(to.inputs.end(),
                     rows.begin() + static_cast<std::ptrdiff_t>((from - past) * width), rows.end());
    to.targets.insert(to.targets.end(), force.begin() + static_cast<std::ptrdiff_t>(from),
                      force.end());
    to.group.resize(to.targets.size(), group);
  }
};

/// A network that reads so many of the columns, its scales those of the samples.
Mlp standardised(const NarxPlan& plan, const TrainingSamples& rows, std::size_t fed_back) {
  constexpr double kReach = 0.75;  // of the force span, on either side of its middle

  // Layers and activations as planned.
  const std::size_t width = rows.inputs.size() / rows.targets.size();
  Mlp mlp = without_weights(width, plan.hidden, plan.activation);
  if (plan.bounded) mlp.activations.back() = Activation::Tanh;

  // The output's scale: a bounded network covers the force span with room to spare.
  if (plan.bounded) {
    const auto [low, high] = std::minmax_element(rows.targets.begin(), rows.targets.end());
    mlp.output_mean = (*low + *high) / 2;
    mlp.output_scale = *high > *low ? kReach * (*high - *low) : 1;
  } else {
    std::tie(mlp.output_mean, mlp.output_scale) = mean_and_scale(rows.targets, 0, 1);
  }

  // Inputs are scaled by the samples, fed-back forces as the output is.
  for (std::size_t k = 0; k < width; ++k) {
    const auto [mean, scale] = k + fed_back < width ? mean_and_scale(rows.inputs, k, width)
                                                    : std::pair(mlp.output_mean, mlp.output_scale);
    mlp.input_mean.push_back(mean);
    mlp.input_scale.push_back(scale);
  }
  return mlp;
}

/// The difference of each record's force zero from the others', as a network without fed-back
/// forces finds it.
std::vector<double> record_offsets(const NarxPlan& plan, const NarxData& data,
                                   const IdentifyOptions& options) {
  constexpr int kIterations = 30;
  const std::size_t width = data.regressors.count(), kept = data.regressors.input_count();

  // The samples without the columns that are fed back.
  TrainingSamples rows = data.samples.rows;
  rows.inputs.clear();
  for (std::size_t at = 0; at < data.samples.rows.inputs.size(); at += width)
    rows.inputs.insert(rows.inputs.end(), &data.samples.rows.inputs[at],
                       &data.samples.rows.inputs[at] + kept);

  // A short training of a network on them, with one offset per record beside it.
  Mlp mlp = standardised(plan, rows, 0);
  mlp.activations.back() = Activation::Identity;
  initialise(mlp, options.seed);
  return train(mlp, rows,
               {.max_iterations = kIterations,
                .on_iteration = [&](int, double) { options.monitor.check(); }})
      .offsets;
}

/// How much a training may cost.
struct Effort {
  double decay;  ///< weight decay: the factor of their squares
  std::size_t starts = 1, members = 1;
  int first_iterations = 15, iterations = 15;
  std::size_t residuals = 1000;
};

/// The stages of a training: series-parallel first, then in free run where the plan asks for it.
class NarxFit {
 public:
  NarxFit(const NarxPlan& plan, const NarxData& data, const IdentifyOptions& options,
          const Effort& effort)
      : plan_(plan), data_(data), options_(options), effort_(effort) {}

  /// Networks with the least free-run error on the training records, the best first.
  std::vector<TrainedMlp> members() const {
    std::vector<TrainedMlp> trained(effort_.starts,
                                    {standardised(plan_, data_.samples.rows, plan_.feedback), {}});
    parallel_for(trained.size(), options_.threads, [&](std::size_t k) {
      initialise(trained[k].mlp, options_.seed + k);
      trained[k].report = series_parallel(trained[k].mlp);
    });
    keep_best(trained);
    if (!will_run_free()) return trained;
    parallel_for(trained.size(), options_.threads, [&](std::size_t k) { free_run(trained[k]); });
    keep_best(trained);
    return trained;
  }

  /// The squared error, N^2, of a network on other records in free run, their offsets taken out.
  double squares_left(const Mlp& mlp, const NarxSamples& samples) const {
    const double rmse = free_run_rmse(mlp, samples, free_run_options());
    return rmse * rmse * static_cast<double>(samples.rows.targets.size());
  }

 private:
  bool will_run_free() const {
    return plan_.feedback > 0 && plan_.training == FeedbackTraining::FreeRun;
  }

  TrainReport series_parallel(Mlp& mlp) const {
    TrainingSamples rows = data_.samples.rows;
    if (plan_.feedback > 0) rows.group.clear();  // the offsets are out
    TrainOptions how{.max_iterations = effort_.first_iterations, .weight_decay = effort_.decay};
    how.on_iteration = [this](int, double) { options_.monitor.check(); };
    TrainReport report = train(mlp, rows, how);
    report.rmse = free_run_rmse(mlp, data_.samples, free_run_options());
    return report;
  }

  void free_run(TrainedMlp& member) const {
    NarxTrainOptions how = free_run_options();
    const std::size_t washout = how.washout;
    for (const std::size_t window : {std::size_t{10}, std::size_t{100}, plan_.window}) {
      if (plan_.window > 0 && window > plan_.window) continue;
      how.window = window;
      const std::size_t spared = window == 0 ? washout : std::min(washout, window / 2);
      how.washout = window == plan_.window ? spared : 0;
      member.report = plan_.through_time ? train_through_time(member.mlp, data_.samples, how)
                                         : train_free_run(member.mlp, data_.samples, how);
    }
    member.report.rmse = free_run_rmse(member.mlp, data_.samples, free_run_options());
  }

  /// Over whole stretches, from the mean force on: a model at work does not know the force it
  /// begins with.
  NarxTrainOptions free_run_options() const {
    constexpr std::size_t kWashout = 20;
    NarxTrainOptions how{.max_iterations = effort_.iterations, .weight_decay = effort_.decay};
    how.most_residuals = effort_.residuals;
    how.washout = plan_.feedback > 0 ? kWashout : 0;
    how.on_iteration = [this] { options_.monitor.check(); };
    return how;
  }

  void keep_best(std::vector<TrainedMlp>& trained) const {
    std::stable_sort(trained.begin(), trained.end(), [](const TrainedMlp& a, const TrainedMlp& b) {
      return a.report.rmse < b.report.rmse;
    });
    trained.resize(std::min(trained.size(), effort_.members));
  }

  const NarxPlan& plan_;
  const NarxData& data_;
  const IdentifyOptions& options_;
  Effort effort_;
};

/// The samples of a training, the differences of their records' force zeros taken out.
NarxData training_data(const NarxPlan& plan, const Regressors& regressors,
                       const std::vector<Record>& records, DriveUnit drive_unit,
                       const IdentifyOptions& options, std::size_t most) {
  NarxData data(regressors, records, drive_unit, most);
  if (options.offset == OffsetMode::None)
    data.samples.rows.group.clear();
  else if (plan.feedback > 0)
    data.remove(record_offsets(plan, data, options));
  return data;
}

/// The weight decay with which short trainings predict best what was held back from them.
double best_decay(const NarxPlan& plan, const Regressors& regressors,
                  const std::vector<Record>& training, DriveUnit drive_unit,
                  const IdentifyOptions& options) {
  if (options.network.l2) return *options.network.l2;
  const std::vector<Fold> folds = trial_folds(training);
  const std::size_t trials = std::min(folds.size(), kMostTrials);
  std::vector<double> squares(trials * kNarxDecays.size());
  parallel_for(squares.size(), options.threads, [&](std::size_t k) {
    // Spread over all: conditions come first, levels of the drive last.
    const Fold& fold = folds[(2 * (k / kNarxDecays.size()) + 1) * folds.size() / (2 * trials)];

    const NarxData seen =
        training_data(plan, regressors, fold.training, drive_unit, options, kTrialRows);
    const NarxData unseen(regressors, fold.left_out, drive_unit, kTrialRows);

    // Train briefly, no longer than the design allows, and score the best network in free run.
    Effort effort{.decay = kNarxDecays[k % kNarxDecays.size()]};
    if (options.network.epochs)
      effort.first_iterations = effort.iterations =
          std::min(effort.iterations, static_cast<int>(*options.network.epochs));
    const NarxFit fit(plan, seen, options, effort);
    squares[k] = fit.squares_left(fit.members().front().mlp, unseen.samples);
  });

  // The decay with the least squares over all trials.
  std::array<double, kNarxDecays.size()> sums{};
  for (std::size_t k = 0; k < squares.size(); ++k) sums[k % kNarxDecays.size()] += squares[k];
  return kNarxDecays[static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) -
                                              sums.begin())];
}

Effort full_effort(const NarxPlan& plan, const IdentifyOptions& options, double decay) {
  Effort effort{
      .decay = decay,
      .starts = std::max(static_cast<std::size_t>(std::max(1, options.starts)), plan.members),
      .members = plan.members,
      .first_iterations = kFirstIterations,
      .iterations = NarxTrainOptions().max_iterations,
      .residuals = NarxTrainOptions().most_residuals};
  const bool runs_free = plan.feedback > 0 && plan.training == FeedbackTraining::FreeRun;
  if (!runs_free) effort.first_iterations = TrainOptions().max_iterations;
  if (options.network.epochs)
    effort.first_iterations = effort.iterations = static_cast<int>(*options.network.epochs);
  return effort;
}

}  // namespace

FitReport fit_narx(const NarxPreset& preset, const std::vector<Record>& training,
                   DriveUnit drive_unit, const IdentifyOptions& options) {
  // The design and the samples.
  const NarxPlan plan(preset, options.network);
  const Regressors regressors = regressors_of(plan, training, drive_unit);
  const NarxData data = training_data(plan, regressors, training, drive_unit, options, kMostRows);

  // The weight decay, found by trials unless it is given, and the training.
  const Effort effort =
      full_effort(plan, options, best_decay(plan, regressors, training, drive_unit, options));
  std::vector<TrainedMlp> trained = NarxFit(plan, data, options, effort).members();

  // Report the members, and warn where the model is free to diverge.
  FitReport report = report_of_members(trained);
  std::vector<Mlp> members;
  for (TrainedMlp& member : trained) members.push_back(std::move(member.mlp));
  const auto model = std::make_shared<NarxModel>(plan.name, regressors, std::move(members));
  if (model->can_diverge())
    report.warnings.push_back(
        "nothing bounds its force in free run: beyond its training data it can diverge, which is "
        "then reported with its time; --network output=bounded rules it out");
  report.model = model;
  return report;
}

}  // namespace dashpot
