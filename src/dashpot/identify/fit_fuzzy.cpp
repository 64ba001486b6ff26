#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/fuzzy/fuzzy_model.h"
#include "dashpot/damper/fuzzy/train.h"
#include "dashpot/identify/fit.h"
#include "dashpot/identify/training_samples.h"

namespace dashpot {
namespace {

double knob(const char* name, double fallback) { const char* v = std::getenv(name); return v ? std::atof(v) : fallback; }

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

TrainingSamples fuzzy_samples(const FuzzyInputs& inputs, const std::vector<Record>& records,
                              const std::string& drive_unit, OffsetMode offset) {
  const auto rows = [&](const std::vector<DamperInput>& motion, const std::vector<double>& time) {
    const std::size_t width = inputs.names().size();
    std::vector<double> values(motion.size() * width), state(inputs.state_size());
    inputs.rest(state);
    for (std::size_t k = 0; k < motion.size(); ++k) {
      if (k > 0) inputs.advance(motion[k - 1], motion[k], time[k] - time[k - 1], state);
      inputs.read(motion[k], state, &values[k * width]);
    }
    return values;
  };
  return training_samples(records, drive_unit, offset, rows);
}

/// Sets of equal width, evenly over the middle of the data; neighbours meet at one half.
void add_sets(Sugeno& sugeno, std::size_t input, std::size_t count, Membership::Shape shape) {
  const double reach = knob("REACH", 1.5);
  const double low = std::max(sugeno.inputs[input].low, -reach), high = std::min(sugeno.inputs[input].high, reach);
  const double step = (high - low) / static_cast<double>(count - 1);
  const double half = step > 0 ? step / 2 : 1;
  const bool bell = shape == Membership::Shape::Bell;
  for (std::size_t k = 0; k < count; ++k)
    sugeno.memberships.push_back({shape, input, low + step * static_cast<double>(k),
                                  bell ? half : half / std::sqrt(2 * std::log(2.0)), bell ? 2.0 : 1.0});
}

/// One rule per combination of a set of each input.
Sugeno starting_grid(const FuzzyPreset& preset, const TrainingSamples& samples) {
  Sugeno sugeno;
  const std::size_t inputs = preset.inputs.size();
  sugeno.rules.emplace_back();
  for (std::size_t k = 0; k < inputs; ++k) {
    Sugeno::Input& input = sugeno.inputs.emplace_back();
    std::tie(input.mean, input.scale) = mean_and_scale(samples.inputs, k, inputs);
    input.low = HUGE_VAL;
    input.high = -HUGE_VAL;
    for (std::size_t s = k; s < samples.inputs.size(); s += inputs) {
      input.low = std::min(input.low, (samples.inputs[s] - input.mean) / input.scale);
      input.high = std::max(input.high, (samples.inputs[s] - input.mean) / input.scale);
    }
    const std::size_t first = sugeno.memberships.size();
    if (preset.sets[k] < 2) continue;
    add_sets(sugeno, k, preset.sets[k], preset.shape);
    std::vector<std::vector<std::size_t>> rules;
    for (const std::vector<std::size_t>& rule : sugeno.rules)
      for (std::size_t m = first; m < sugeno.memberships.size(); ++m) {
        rules.push_back(rule);
        rules.back().push_back(m);
      }
    sugeno.rules = std::move(rules);
  }
  std::tie(sugeno.output_mean, sugeno.output_scale) = mean_and_scale(samples.targets, 0, 1);
  return sugeno;
}

}  // namespace

FitReport fit_fuzzy(const FuzzyPreset& original, const std::vector<Record>& training, const std::string& drive_unit,
                    const IdentifyOptions& options) {
  FuzzyPreset preset = original;
  if (const char* s = std::getenv("SETS"); s) { preset.sets.clear(); for (; *s; ++s) preset.sets.push_back(*s - '0'); }
  if (const char* s = std::getenv("INPUTS"); s) { preset.inputs.clear(); for (; *s; ++s) preset.inputs.push_back(*s == 'x' ? "displacement" : *s == 'v' ? "velocity" : *s == 'd' ? "velocity_change" : "current"); }
  if (const char* s = std::getenv("SHAPE"); s) preset.shape = *s == 'g' ? Membership::Shape::Gaussian : Membership::Shape::Bell;
  FuzzyTrainOptions train_options;
  train_options.on_iteration = [&](int) { options.monitor.check(); };
  train_options.ridge = knob("RIDGE", 1e-4);
  train_options.premise_decay = knob("DECAY", 1e-4);
  train_options.max_iterations = (int)knob("ITER", 60);
  const FuzzyInputs inputs(preset.inputs, knob("LAG", 0.02), std::string(preset.name));
  const TrainingSamples samples = thinned(fuzzy_samples(inputs, training, drive_unit, options.offset), (std::size_t)knob("MOST", 20000));
  Sugeno sugeno = starting_grid(preset, samples);
  const TrainReport trained = train(sugeno, samples, train_options);
  FitReport report;
  report.status = trained.converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
  report.message = trained.converged ? "converged" : "iteration limit reached";
  report.iterations = trained.iterations;
  report.training_rmse = trained.rmse;
  if (getenv("VERBOSE")) fprintf(stderr, "rmse %g iterations %d conv %d n %zu\n", trained.rmse, trained.iterations, trained.converged, samples.targets.size());
  report.model = std::make_shared<FuzzyModel>(std::string(preset.name), inputs, std::move(sugeno));
  return report;
}

}  // namespace dashpot
