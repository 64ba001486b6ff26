#include <algorithm>
#include <array>
#include <span>
#include <tuple>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"
#include "dashpot/damper/kinds/fuzzy/presets.h"
#include "dashpot/damper/kinds/fuzzy/train_fuzzy.h"
#include "dashpot/damper/nets/standardise.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/training_samples.h"

namespace dashpot {
namespace {

constexpr std::size_t kSamples = 20000;      // of a fit: hundreds for each number that it finds
constexpr std::size_t kTrialSamples = 4000;  // of a trial of lags
constexpr int kTrialIterations = 8;
constexpr std::array kVelocityLags{0.001, 0.0025, 0.005, 0.01, 0.02, 0.04};
constexpr std::array kCoilLags{0.0, 0.0025, 0.005, 0.01, 0.02, 0.04};

/// Every k-th sample, so that no more than `most` are left.
TrainingSamples thinned(TrainingSamples samples, std::size_t most) {
  const std::size_t count = samples.targets.size(), stride = (count + most - 1) / most;
  if (stride <= 1) return samples;
  const std::size_t inputs = samples.inputs.size() / count;
  TrainingSamples result;
  result.groups = samples.groups;
  for (std::size_t k = 0; k < count; k += stride) {
    const auto row = samples.inputs.begin() + static_cast<std::ptrdiff_t>(k * inputs);
    result.inputs.insert(result.inputs.end(), row, row + static_cast<std::ptrdiff_t>(inputs));
    result.targets.push_back(samples.targets[k]);
    if (!samples.group.empty()) result.group.push_back(samples.group[k]);
  }
  return result;
}

std::vector<double> rows_of(const FuzzyInputs& inputs, const std::vector<DamperInput>& motion,
                            const std::vector<double>& time) {
  const std::size_t width = inputs.names().size();
  std::vector<double> values(motion.size() * width), state(inputs.state_size());
  for (std::size_t k = 0; k < motion.size(); ++k) {
    if (k == 0)
      inputs.rest(motion[0], state);
    else
      inputs.advance(motion[k - 1], motion[k], time[k] - time[k - 1], state);
    inputs.read(motion[k], state, &values[k * width]);
  }
  return values;
}

/// Sets of equal width, evenly over the middle of the data; neighbours meet at one half.
void add_sets(Sugeno& sugeno, std::size_t input, std::size_t count, Membership::Shape shape) {
  constexpr double kMiddle = 1.5;        // standard deviations
  constexpr double kHalfHeight = 1.177;  // a Gaussian's, in its own widths
  const double low = std::max(sugeno.inputs[input].low, -kMiddle);
  const double high = std::min(sugeno.inputs[input].high, kMiddle);
  const double step = high > low ? (high - low) / static_cast<double>(count - 1) : 1;
  const bool gaussian = shape == Membership::Shape::Gaussian;
  for (std::size_t k = 0; k < count; ++k)
    sugeno.memberships.push_back({shape, input, low + step * static_cast<double>(k),
                                  gaussian ? step / 2 / kHalfHeight : step / 2,
                                  gaussian ? 1.0 : 2.0});
}

/// Rules for every combination of those so far and the memberships from `first` on.
void cross(std::vector<std::vector<std::size_t>>& rules, std::size_t first, std::size_t end) {
  std::vector<std::vector<std::size_t>> result;
  for (const std::vector<std::size_t>& rule : rules)
    for (std::size_t m = first; m < end; ++m) {
      result.push_back(rule);
      result.back().push_back(m);
    }
  rules = std::move(result);
}

Sugeno starting_grid(const FuzzyPreset& preset, const TrainingSamples& samples) {
  Sugeno sugeno;
  sugeno.rules.emplace_back();
  const std::size_t inputs = preset.inputs.size();
  for (std::size_t k = 0; k < inputs; ++k) {
    // The input's scale and its range, standardised.
    Sugeno::Input input;
    std::tie(input.mean, input.scale) = mean_and_scale(samples.inputs, k, inputs);
    input.low = input.high = (samples.inputs[k] - input.mean) / input.scale;
    for (std::size_t s = k; s < samples.inputs.size(); s += inputs) {
      input.low = std::min(input.low, (samples.inputs[s] - input.mean) / input.scale);
      input.high = std::max(input.high, (samples.inputs[s] - input.mean) / input.scale);
    }
    sugeno.inputs.push_back(input);

    // Its sets, crossed with the rules so far; an input with one set only enters the consequents.
    if (preset.sets[k] < 2) continue;
    const std::size_t first = sugeno.memberships.size();
    add_sets(sugeno, k, preset.sets[k], preset.shape);
    cross(sugeno.rules, first, sugeno.memberships.size());
  }

  std::tie(sugeno.output_mean, sugeno.output_scale) = mean_and_scale(samples.targets, 0, 1);
  return sugeno;
}

/// One preset on one set of records.
class FuzzyFit {
 public:
  FuzzyFit(const FuzzyPreset& preset, const std::vector<Record>& training, DriveUnit drive_unit,
           const IdentifyOptions& options)
      : preset_(preset), training_(training), drive_unit_(drive_unit), options_(options) {}

  struct Result {
    FuzzyInputs inputs;
    Sugeno sugeno;
    TrainReport report;
  };

  /// The lags that short fits like best: first the velocity's, then the coil's where the current
  /// changes.
  FuzzyInputs::Lags find_lags() const {
    FuzzyInputs::Lags lags;
    const FuzzyInputs inputs(preset_.inputs, lags, {});
    if (inputs.has("velocity_change")) choose(lags, &FuzzyInputs::Lags::velocity, kVelocityLags);
    if (drive_range(training_, drive_unit_).varies)
      choose(lags, &FuzzyInputs::Lags::coil, kCoilLags);
    return lags;
  }

  Result fit(FuzzyInputs::Lags lags, std::size_t most_samples, int iterations) const {
    const FuzzyInputs inputs(preset_.inputs, lags, std::string(preset_.name));
    const auto rows = [&](const std::vector<DamperInput>& motion, const std::vector<double>& time) {
      return rows_of(inputs, motion, time);
    };
    const TrainingSamples samples =
        thinned(training_samples(training_, drive_unit_, options_.offset, rows), most_samples);
    FuzzyTrainOptions train_options;
    train_options.max_iterations = iterations;
    train_options.on_iteration = [this](int) { options_.monitor.check(); };
    Sugeno sugeno = starting_grid(preset_, samples);
    const TrainReport report = train(sugeno, samples, train_options);
    return {inputs, std::move(sugeno), report};
  }

 private:
  void choose(FuzzyInputs::Lags& lags, double FuzzyInputs::Lags::* lag,
              std::span<const double> values) const {
    std::vector<double> rmse(values.size());
    parallel_for(values.size(), options_.threads, [&](std::size_t k) {
      FuzzyInputs::Lags trial = lags;
      trial.*lag = values[k];
      rmse[k] = fit(trial, kTrialSamples, kTrialIterations).report.rmse;
    });
    lags.*lag =
        values[static_cast<std::size_t>(std::min_element(rmse.begin(), rmse.end()) - rmse.begin())];
  }

  const FuzzyPreset& preset_;
  const std::vector<Record>& training_;
  DriveUnit drive_unit_;
  const IdentifyOptions& options_;
};

}  // namespace

FitReport fit_fuzzy(const FuzzyPreset& preset, const std::vector<Record>& training,
                    DriveUnit drive_unit, const IdentifyOptions& options) {
  const FuzzyFit search(preset, training, drive_unit, options);
  FuzzyFit::Result best =
      search.fit(search.find_lags(), kSamples, FuzzyTrainOptions{}.max_iterations);
  FitReport report;
  report.status =
      best.report.converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
  report.message = best.report.converged ? "converged" : "iteration limit reached";
  report.iterations = best.report.iterations;
  report.training_rmse = best.report.rmse;
  report.model = std::make_shared<FuzzyModel>(std::string(preset.name), std::move(best.inputs),
                                              std::move(best.sugeno));
  return report;
}

}  // namespace dashpot
