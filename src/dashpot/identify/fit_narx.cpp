#include <algorithm>
#include <cmath>
#include <tuple>

#include "dashpot/base/error.h"
#include "dashpot/base/parallel.h"
#include "dashpot/damper/neural/ensemble.h"
#include "dashpot/damper/neural/narx_model.h"
#include "dashpot/damper/neural/train_narx.h"
#include "dashpot/identify/fit.h"
#include "dashpot/identify/training_samples.h"
#include "dashpot/record/time_base.h"

namespace dashpot {
namespace {

constexpr std::size_t kMostRows = 6000;  // of regressors; of finer records some of the grids that lie in them

/// What preset and design make together.
struct NarxPlan {
  NarxPlan(const NetworkPreset& preset, const NetworkDesign& design)
      : name(preset.name),
        inputs(preset.inputs),
        hidden(design.hidden.empty() ? preset.hidden : design.hidden),
        activation(design.activation.value_or(Activation::Tanh)),
        delays(design.delays.value_or(preset.delays)),
        feedback(design.feedback.value_or(preset.feedback)),
        spacing(design.spacing.value_or(preset.spacing)),
        members(design.members.value_or(1)),
        training(design.training.value_or(FeedbackTraining::FreeRun)),
        window(design.window.value_or(0)),
        bounded(design.output.value_or(OutputRange::Linear) == OutputRange::Bounded) {}

  std::string name;
  std::vector<std::string> inputs;
  std::vector<std::size_t> hidden;
  Activation activation;
  std::size_t delays, feedback, spacing, members;
  FeedbackTraining training;
  std::size_t window;
  bool bounded;
};

/// The training records on the network's own grid.
class NarxData {
 public:
  NarxData(const NarxPlan& plan, const std::vector<Record>& training, const std::string& drive_unit) {
    double step = 0, seconds = 0;
    for (const Record& record : training) {
      step = std::max(step, step_of(record));
      seconds += record.time.back() - record.time.front();
    }
    regressors = Regressors::of(plan.inputs, plan.delays, plan.feedback,
                                static_cast<double>(std::max<std::size_t>(1, plan.spacing)) * step);
    const auto most = static_cast<std::size_t>(
        std::max(1.0, static_cast<double>(kMostRows) * regressors.sample_time / seconds));
    samples.feedback = regressors.feedback;
    samples.rows.groups = training.size();
    for (std::size_t r = 0; r < training.size(); ++r) {
      // Of a finer record, each grid that lies in it: every so many-th sample, from several first ones on.
      const auto grids =
          static_cast<std::size_t>(std::max(1.0, std::round(regressors.sample_time / step_of(training[r]))));
      const std::size_t taken = std::min(grids, most);
      for (std::size_t k = 0; k < taken; ++k) add(training[r], r, k * grids / taken, drive_unit);
    }
    if (samples.rows.targets.empty())
      throw Error(training.front().name, "no record is longer than the network's past",
                  "fewer delays, or a smaller spacing");
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
  static double step_of(const Record& record) {
    if (record.sample_time > 0) return record.sample_time;
    return (record.time.back() - record.time.front()) / static_cast<double>(record.size() - 1);
  }

  void add(const Record& record, std::size_t group, std::size_t first, const std::string& drive_unit) {
    const double step = regressors.sample_time;
    if (record.time.back() - record.time[first] < step * static_cast<double>(regressors.depth() + 2)) return;
    Record grid = record.slice(first, record.size());
    const double warm_up = record.time[record.warm_up] - record.time[first];
    if (step != record.sample_time) resample(grid, 1 / step);
    const std::vector<double>& force = grid.channel("force").samples;
    std::vector<double> rows = regressor_rows(regressors, damper_inputs(grid, drive_unit), force);
    const std::size_t past = regressors.depth(), width = regressors.count();
    const auto scored = static_cast<std::size_t>(std::max(0.0, std::ceil(warm_up / step - 1e-6)));
    const std::size_t from = std::max(past, scored);
    if (from >= force.size()) return;
    TrainingSamples& to = samples.rows;
    samples.stretches.push_back(to.targets.size());
    to.inputs.insert(to.inputs.end(), rows.begin() + static_cast<std::ptrdiff_t>((from - past) * width),
                     rows.end());
    to.targets.insert(to.targets.end(), force.begin() + static_cast<std::ptrdiff_t>(from), force.end());
    to.group.resize(to.targets.size(), group);
  }
};

/// A network that reads so many of the columns, its scales those of the samples.
Mlp standardised(const NarxPlan& plan, const TrainingSamples& rows, std::size_t fed_back) {
  constexpr double kReach = 0.75;  // of the force span, on either side of its middle
  const std::size_t width = rows.inputs.size() / rows.targets.size();
  Mlp mlp;
  mlp.layers.push_back(width);
  mlp.layers.insert(mlp.layers.end(), plan.hidden.begin(), plan.hidden.end());
  mlp.layers.push_back(1);
  mlp.activations.assign(plan.hidden.size(), plan.activation);
  mlp.activations.push_back(plan.bounded ? Activation::Tanh : Activation::Identity);
  mlp.parameters.resize(Mlp::parameter_count(mlp.layers));
  if (plan.bounded) {
    const auto [low, high] = std::minmax_element(rows.targets.begin(), rows.targets.end());
    mlp.output_mean = (*low + *high) / 2;
    mlp.output_scale = *high > *low ? kReach * (*high - *low) : 1;
  } else {
    std::tie(mlp.output_mean, mlp.output_scale) = mean_and_scale(rows.targets, 0, 1);
  }
  for (std::size_t k = 0; k < width; ++k) {
    const auto [mean, scale] = k + fed_back < width ? mean_and_scale(rows.inputs, k, width)
                                                    : std::pair(mlp.output_mean, mlp.output_scale);
    mlp.input_mean.push_back(mean);
    mlp.input_scale.push_back(scale);
  }
  return mlp;
}

/// What the force zeros of the records differ by, as a network without fed-back forces finds it.
std::vector<double> record_offsets(const NarxPlan& plan, const NarxData& data,
                                   const IdentifyOptions& options) {
  constexpr int kIterations = 30;
  const std::size_t width = data.regressors.count(), kept = data.regressors.input_count();
  TrainingSamples rows = data.samples.rows;
  rows.inputs.clear();
  for (std::size_t at = 0; at < data.samples.rows.inputs.size(); at += width)
    rows.inputs.insert(rows.inputs.end(), &data.samples.rows.inputs[at],
                       &data.samples.rows.inputs[at] + kept);
  Mlp mlp = standardised(plan, rows, 0);
  mlp.activations.back() = Activation::Identity;
  initialise(mlp, options.seed);
  return train(mlp, rows,
               {.max_iterations = kIterations, .on_iteration = [&](int, double) { options.monitor.check(); }})
      .offsets;
}

/// What the stages of a training share.
class NarxFit {
 public:
  NarxFit(const NarxPlan& plan, const NarxData& data, const IdentifyOptions& options)
      : plan_(plan), data_(data), options_(options) {}

  /// Networks with the least free-run error on the training records, the best first.
  std::vector<TrainedMlp> members() const {
    const std::size_t starts =
        std::max(static_cast<std::size_t>(std::max(1, options_.starts)), plan_.members);
    const Mlp start = standardised(plan_, data_.samples.rows, plan_.feedback);
    std::vector<TrainedMlp> trained = train_from_starts(start, starts, options_.seed, options_.threads,
                                                        [&](Mlp& mlp) { return series_parallel(mlp); });
    keep_best(trained);
    if (plan_.feedback == 0 || plan_.training == FeedbackTraining::SeriesParallel) return trained;
    parallel_for(trained.size(), options_.threads, [&](std::size_t k) { free_run(trained[k]); });
    keep_best(trained);
    return trained;
  }

 private:
  std::function<void()> check() const {
    return [this] { options_.monitor.check(); };
  }

  TrainReport series_parallel(Mlp& mlp) const {
    TrainingSamples rows = data_.samples.rows;
    if (plan_.feedback > 0 || options_.offset == OffsetMode::None) rows.group.clear();
    TrainOptions how{.weight_decay = options_.network.l2.value_or(plan_.feedback > 0 ? 1e-6 : 3e-4)};
    how.on_iteration = [this](int, double) { options_.monitor.check(); };
    if (options_.network.epochs) how.max_iterations = static_cast<int>(*options_.network.epochs);
    TrainReport report = train(mlp, rows, how);
    report.rmse = free_run_rmse(mlp, data_.samples, free_run_options());
    return report;
  }

  void free_run(TrainedMlp& member) const {
    NarxTrainOptions how = free_run_options();
    const bool through_time = options_.network.trainer == Trainer::Lbfgs;
    for (const std::size_t window : {std::size_t{10}, std::size_t{100}, plan_.window}) {
      if (plan_.window > 0 && window > plan_.window) continue;
      how.window = window;
      member.report = through_time ? train_through_time(member.mlp, data_.samples, how)
                                   : train_free_run(member.mlp, data_.samples, how);
    }
    member.report.rmse = free_run_rmse(member.mlp, data_.samples, free_run_options());
  }

  /// Over whole stretches.
  NarxTrainOptions free_run_options() const {
    NarxTrainOptions how{.weight_decay = options_.network.l2.value_or(1e-5), .on_iteration = check()};
    if (options_.offset == OffsetMode::None) how.offset_decay = 1e9;
    if (options_.network.epochs) how.max_iterations = static_cast<int>(*options_.network.epochs);
    return how;
  }

  void keep_best(std::vector<TrainedMlp>& trained) const {
    std::stable_sort(trained.begin(), trained.end(),
                     [](const TrainedMlp& a, const TrainedMlp& b) { return a.report.rmse < b.report.rmse; });
    trained.resize(std::min(trained.size(), plan_.members));
  }

  const NarxPlan& plan_;
  const NarxData& data_;
  const IdentifyOptions& options_;
};

}  // namespace

FitReport fit_narx(const NetworkPreset& preset, const std::vector<Record>& training,
                   const std::string& drive_unit, const IdentifyOptions& options) {
  const NarxPlan plan(preset, options.network);
  NarxData data(plan, training, drive_unit);
  if (plan.feedback > 0 && options.offset == OffsetMode::Record)
    data.remove(record_offsets(plan, data, options));
  FitReport report;
  std::vector<Mlp> members;
  bool converged = true;
  for (TrainedMlp& member : NarxFit(plan, data, options).members()) {
    members.push_back(std::move(member.mlp));
    converged = converged && member.report.converged;
    report.iterations = std::max(report.iterations, member.report.iterations);
    report.training_rmse += member.report.rmse / static_cast<double>(plan.members);
  }
  report.status = converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
  report.message = converged ? "converged" : "iteration limit reached";
  report.model = std::make_shared<NarxModel>(plan.name, data.regressors, std::move(members));
  return report;
}

}  // namespace dashpot
