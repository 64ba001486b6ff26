#include "dashpot/identify/fit/fit_inverse.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/evaluate.h"
#include "dashpot/record/trial_parts.h"

namespace dashpot {
namespace {

InverseLimits limits_of(const InverseTraining& training, double sample_time) {
  return {training.current_min, training.current_max, sample_time, 0};
}

/// Weights by speed: near standstill the force says nothing of the current.
std::vector<double> weight_by_speed(const std::vector<DamperInput>& inputs) {
  constexpr double kShare = 0.2;  // of the rms speed
  double squares = 0;
  for (const DamperInput& input : inputs) squares += input.velocity * input.velocity;
  const double half = kShare * kShare * squares / static_cast<double>(inputs.size());
  std::vector<double> weight;
  for (const DamperInput& input : inputs) {
    const double square = input.velocity * input.velocity;
    weight.push_back(square > 0 ? square / (square + half) : 0);
  }
  return weight;
}

/// Takes a record's zero off its force: the mean of what the model does not explain.
void remove_zero(InverseRun& run, const DamperModel& forward, const Record& record) {
  const FreeRun model = free_run(forward, run.inputs, record.time);
  double sum = 0;
  for (std::size_t k = record.warm_up; k < run.size(); ++k) sum += run.force[k] - model.force[k];
  const double zero = sum / static_cast<double>(run.size() - record.warm_up);
  for (double& force : run.force) force -= zero;
}

InverseRun run_of(const Record& record, DriveUnit drive_unit, const DamperModel* forward,
                  const InverseTraining& training) {
  if (record.sample_time == 0)
    throw Error(record.name, "is not sampled at equal steps of time", "resample it");

  // The record as a run, its currents within the range of the training.
  std::vector<DamperInput> inputs = damper_inputs(record, drive_unit);
  for (DamperInput& input : inputs)
    input.current = std::clamp(input.current, training.current_min, training.current_max);
  InverseRun run{.name = record.name,
                 .sample_time = record.sample_time,
                 .inputs = inputs,
                 .force = record.channel("force").samples,
                 .weight = {}};

  // Weights and the force's zero from the model where there is one, else weights by speed alone.
  if (forward) {
    run.weight =
        run_on_model(*forward, record.name, inputs, limits_of(training, record.sample_time)).weight;
    remove_zero(run, *forward, record);
  } else {
    run.weight = weight_by_speed(inputs);
  }

  // The warm-up does not count.
  std::fill_n(run.weight.begin(), record.warm_up, 0.0);
  return run;
}

void require_serving(const Dataset& dataset, const InverseNetworkPreset& preset) {
  const DriveRange drive = drive_range(dataset.records, dataset.drive_unit);
  const std::string unit = " " + to_string(dataset.drive_unit);

  // One current throughout says nothing of any other.
  if (!(drive.low < drive.high))
    throw Error(dataset.name,
                "the drive is " + format_number(drive.low) + unit +
                    " throughout: nothing tells what another would do",
                "take records at several, or teach the inverse on a model");

  // A constant drive in each record teaches a network that reads its own currents only to hold
  // them.
  const auto taps_of = [&](Tap::Signal signal) {
    return std::ranges::any_of(preset.taps, [&](const Tap& tap) { return tap.signal == signal; });
  };
  if (!drive.varies && taps_of(Tap::Signal::Current))
    throw Error(
        dataset.name,
        "the drive is constant within each record: " + std::string(preset.name) +
            " would only learn to hold on to its own past current",
        "take 'history', 'one_sensor' or 'static', or teach it on a model of these records");

  // Every signal that the network reads must have been recorded.
  for (const Record& record : dataset.records)
    if (taps_of(Tap::Signal::Displacement) && !record.find("displacement"))
      throw Error(record.name, "has no displacement, which " + std::string(preset.name) + " needs",
                  "take 'one_sensor'");
}

/// The records of a dataset as runs, and what is taught on parts of them.
class RecordTeacher {
 public:
  RecordTeacher(const Dataset& dataset, const LeaveOut& leave_out, const DamperModel* forward,
                const InverseFitOptions& options)
      : dataset_(dataset),
        leave_out_(leave_out),
        forward_(forward),
        options_(options),
        preset_(find_inverse_network(options.network)) {
    require_serving(dataset, preset_);
    const DriveRange drive = drive_range(dataset.records, dataset.drive_unit);
    options_.training.current_min = drive.low;
    options_.training.current_max = drive.high;
    options_.training.threads = 1;  // the folds are spread over them
  }

  /// Early stopping looks at a part of the training records.
  TaughtInverse teach(const std::vector<Record>& training) const {
    const Fold inner = hold_back(training, leave_out_).front();
    return train_inverse(preset_, runs(inner.training), runs(inner.left_out), options_.training);
  }

  std::vector<InverseRun> runs(const std::vector<Record>& records) const {
    std::vector<InverseRun> all;
    for (const Record& record : records)
      all.push_back(run_of(record, dataset_.drive_unit, forward_, options_.training));
    return all;
  }

  const InverseTraining& training() const { return options_.training; }

 private:
  const Dataset& dataset_;
  const LeaveOut& leave_out_;
  const DamperModel* forward_;
  InverseFitOptions options_;
  const InverseNetworkPreset& preset_;
};

std::vector<std::vector<double>> all_answers(const InverseNetwork& network,
                                             const std::vector<InverseRun>& runs) {
  std::vector<std::vector<double>> all;
  for (const InverseRun& run : runs) all.push_back(answers(network, run));
  return all;
}

/// Each record's currents by a network that did not see it.
double left_out_error(const RecordTeacher& teacher, const std::vector<Fold>& folds, int threads) {
  std::vector<std::vector<InverseRun>> runs(folds.size());
  std::vector<std::vector<std::vector<double>>> currents(folds.size());
  parallel_for(folds.size(), threads, [&](std::size_t f) {
    runs[f] = teacher.runs(folds[f].left_out);
    currents[f] = all_answers(teacher.teach(folds[f].training).network, runs[f]);
  });
  std::vector<InverseRun> every_run;
  std::vector<std::vector<double>> every_current;
  for (std::size_t f = 0; f < folds.size(); ++f) {
    std::ranges::move(runs[f], std::back_inserter(every_run));
    std::ranges::move(currents[f], std::back_inserter(every_current));
  }
  return weighted_error(every_run, every_current);
}

Domain domain_of(const std::vector<InverseRun>& runs, const InverseLimits& limits) {
  Domain domain{.current_min = limits.current_min, .current_max = limits.current_max};
  for (const InverseRun& run : runs)
    for (const DamperInput& input : run.inputs) {
      domain.displacement_min = std::min(domain.displacement_min, input.displacement);
      domain.displacement_max = std::max(domain.displacement_max, input.displacement);
      domain.velocity_min = std::min(domain.velocity_min, input.velocity);
      domain.velocity_max = std::max(domain.velocity_max, input.velocity);
    }
  return domain;
}

}  // namespace

InverseFit fit_inverse(const DamperModel& forward, const MotionRange& range,
                       const InverseLimits& limits, const InverseFitOptions& options) {
  InverseTraining training = options.training;
  training.current_min = limits.current_min;
  training.current_max = limits.current_max;

  // Drive the model through tests of three different seeds, one set for each use.
  std::vector<InverseRun> runs[3];  // for training, for early stopping, for the figure
  InverseFit fit;
  std::vector<std::string> tests;
  for (std::size_t part = 0; part < std::size(runs); ++part)
    for (const BenchTest& test : teaching_tests(range, limits, training.seed + part)) {
      runs[part].push_back(run_on_model(forward, test, limits));
      if (part == 0) tests.push_back(test.name);
    }

  // Train the network, and describe what it was trained on.
  TaughtInverse taught =
      train_inverse(find_inverse_network(options.network), runs[0], runs[1], training);
  fit.network = std::move(taught.network);
  fit.network.rate_max = options.rate_max;
  fit.teacher = forward.name() + " on " + join(tests, "; ");
  fit.domain = domain_of(runs[0], limits);

  // The errors, on the tests of the training and on those that it never saw.
  fit.training_rmse = taught.training_rmse;
  fit.left_out_rmse = weighted_error(runs[2], all_answers(fit.network, runs[2]));
  return fit;
}

InverseFit fit_inverse(const Dataset& dataset, const LeaveOut& leave_out,
                       const DamperModel* forward, const InverseFitOptions& options) {
  const RecordTeacher teacher(dataset, leave_out, forward, options);

  // The error on left-out records comes from the folds' networks, the network from all records.
  InverseFit fit;
  fit.left_out_rmse = left_out_error(teacher, split(dataset, leave_out), options.training.threads);
  TaughtInverse taught = teacher.teach(dataset.records);
  fit.network = std::move(taught.network);
  fit.network.rate_max = options.rate_max;
  fit.training_rmse = taught.training_rmse;

  // Describe the records of the training, and warn of what they cannot show.
  for (const Record& record : dataset.records) fit.records.push_back(record.name);
  fit.teacher = std::to_string(fit.records.size()) + " records of " + dataset.name;
  fit.domain = dashpot::domain_of(dataset.records, dataset.drive_unit);
  if (!drive_range(dataset.records, dataset.drive_unit).varies)
    fit.warnings.emplace_back(
        "the drive is constant within each record: how the damper answers to a change is not in "
        "these data");
  return fit;
}

MotionRange motion_range(const Domain& domain) {
  MotionRange range{std::max(-domain.displacement_min, domain.displacement_max), 1};
  if (!(range.amplitude > 0))
    range.amplitude = MotionRange{}.amplitude;  // the model does not feel it
  range.frequency = std::max(-domain.velocity_min, domain.velocity_max) / range.speed();
  return range;
}

std::vector<InverseTrial> inverse_trials(const DamperModel& forward, const MotionRange& range,
                                         const InverseLimits& limits) {
  constexpr double kForceBand = 2;       // Hz
  constexpr std::uint64_t kSeed = 1001;  // no network's training

  // The three motions, within the amplitude and the frequency of the range.
  const MotionOptions noise{.amplitude = range.amplitude,
                            .frequency = range.frequency,
                            .duration = 10,
                            .sample_time = limits.sample_time,
                            .seed = kSeed};
  MotionOptions faster = noise, sine = noise;
  faster.amplitude *= 0.5;
  faster.frequency *= 1.5;
  faster.seed = kSeed + 1;
  sine.amplitude *= 0.8;
  sine.frequency = range.speed() / (2 * std::numbers::pi * range.amplitude);

  // Each with a force that the damper can give along it.
  std::vector<InverseTrial> trials{{"noise", random_motion(noise), {}},
                                   {"fast noise", random_motion(faster), {}},
                                   {"sine", sine_motion(sine), {}}};
  for (std::size_t k = 0; k < trials.size(); ++k)
    trials[k].wanted =
        admissible_force(forward, trials[k].motion, limits, kForceBand, kSeed + 10 + k);
  return trials;
}

}  // namespace dashpot
