#include <algorithm>
#include <cmath>
#include <tuple>

#include "dashpot/base/error.h"
#include "dashpot/damper/neural/ensemble.h"
#include "dashpot/damper/neural/narx_model.h"
#include "dashpot/damper/neural/train_narx.h"
#include "dashpot/identify/fit.h"
#include "dashpot/identify/training_samples.h"
#include "dashpot/record/time_base.h"

namespace dashpot {
namespace {

constexpr std::size_t kMostRows =
    20000;  // of regressors; of finer records some of the grids that lie in them

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
        bounded(design.output.value_or(OutputRange::Linear) == OutputRange::Bounded) {}

  std::string name;
  std::vector<std::string> inputs;
  std::vector<std::size_t> hidden;
  Activation activation;
  std::size_t delays, feedback, spacing, members;
  FeedbackTraining training;
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

/// One training from its start: series-parallel, then over longer and longer windows in free run.
TrainReport train_one(Mlp& mlp, const NarxPlan& plan, const NarxData& data, const IdentifyOptions& options) {
  const NetworkDesign& design = options.network;
  const auto check = [&] { options.monitor.check(); };
  TrainingSamples rows = data.samples.rows;
  if (plan.feedback > 0 || options.offset == OffsetMode::None) rows.group.clear();
  TrainOptions first{.weight_decay = design.l2.value_or(plan.feedback > 0 ? 1e-6 : 3e-4)};
  first.on_iteration = [&](int, double) { check(); };
  if (design.epochs) first.max_iterations = static_cast<int>(*design.epochs);
  TrainReport report = train(mlp, rows, first);
  NarxTrainOptions then{.weight_decay = design.l2.value_or(1e-5), .on_iteration = check};
  if (options.offset == OffsetMode::None) then.offset_decay = 1e9;
  if (design.epochs) then.max_iterations = static_cast<int>(*design.epochs);
  if (plan.feedback > 0 && plan.training == FeedbackTraining::FreeRun)
    for (const std::size_t window : {10, 100, 0}) {
      then.window = window;
      report = design.trainer == Trainer::Lbfgs ? train_through_time(mlp, data.samples, then)
                                                : train_free_run(mlp, data.samples, then);
    }
  then.window = 0;
  report.rmse = free_run_rmse(mlp, data.samples, then);
  return report;
}

}  // namespace

FitReport fit_narx(const NetworkPreset& preset, const std::vector<Record>& training,
                   const std::string& drive_unit, const IdentifyOptions& options) {
  const NarxPlan plan(preset, options.network);
  NarxData data(plan, training, drive_unit);
  if (plan.feedback > 0 && options.offset == OffsetMode::Record)
    data.remove(record_offsets(plan, data, options));
  const std::size_t starts =
      std::max<std::size_t>(static_cast<std::size_t>(std::max(1, options.starts)), plan.members);
  std::vector<TrainedMlp> trained =
      train_from_starts(standardised(plan, data.samples.rows, plan.feedback), starts, options.seed,
                        options.threads, [&](Mlp& mlp) { return train_one(mlp, plan, data, options); });
  std::stable_sort(trained.begin(), trained.end(),
                   [](const TrainedMlp& a, const TrainedMlp& b) { return a.report.rmse < b.report.rmse; });
  FitReport report;
  std::vector<Mlp> members;
  for (std::size_t k = 0; k < plan.members; ++k) members.push_back(trained[k].mlp);
  report.status =
      trained.front().report.converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
  report.message = trained.front().report.converged ? "converged" : "iteration limit reached";
  report.iterations = trained.front().report.iterations;
  report.training_rmse = trained.front().report.rmse;
  report.model = std::make_shared<NarxModel>(plan.name, data.regressors, std::move(members));
  return report;
}

}  // namespace dashpot
