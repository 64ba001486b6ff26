#include <cmath>

#include "dashpot/damper/neural/ensemble.h"
#include "dashpot/damper/neural/network_model.h"
#include "dashpot/identify/fit.h"

namespace dashpot {
namespace {

double input_of(const DamperInput& input, std::string_view name) {
  if (name == "displacement") return input.displacement;
  return name == "velocity" ? input.velocity : input.current;
}

TrainingSamples training_samples(const NetworkPreset& preset, const std::vector<Record>& records,
                                 const std::string& drive_unit, OffsetMode offset) {
  TrainingSamples samples;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const std::vector<DamperInput> inputs = damper_inputs(records[r], drive_unit);
    const std::vector<double>& force = records[r].channel("force").samples;
    for (std::size_t k = records[r].warm_up; k < inputs.size(); ++k) {
      for (const std::string& name : preset.inputs) samples.inputs.push_back(input_of(inputs[k], name));
      samples.targets.push_back(force[k]);
      if (offset == OffsetMode::Record) samples.group.push_back(r);
    }
  }
  if (offset == OffsetMode::Record) samples.groups = records.size();
  return samples;
}

/// Mean and standard deviation of every `stride`-th value from `first` on; a constant has scale 1.
std::pair<double, double> mean_and_scale(const std::vector<double>& values, std::size_t first,
                                         std::size_t stride) {
  double sum = 0, square = 0;
  std::size_t n = 0;
  for (std::size_t k = first; k < values.size(); k += stride, ++n) sum += values[k];
  const double mean = sum / static_cast<double>(n);
  for (std::size_t k = first; k < values.size(); k += stride)
    square += (values[k] - mean) * (values[k] - mean);
  const double deviation = std::sqrt(square / static_cast<double>(n));
  return {mean, deviation > 1e-12 * (std::abs(mean) + 1e-300) ? deviation : 1.0};
}

Mlp standardised(const NetworkPreset& preset, const TrainingSamples& samples) {
  Mlp mlp;
  mlp.layers.push_back(preset.inputs.size());
  mlp.layers.insert(mlp.layers.end(), preset.hidden.begin(), preset.hidden.end());
  mlp.layers.push_back(1);
  mlp.parameters.resize(Mlp::parameter_count(mlp.layers));
  for (std::size_t k = 0; k < preset.inputs.size(); ++k) {
    const auto [mean, scale] = mean_and_scale(samples.inputs, k, preset.inputs.size());
    mlp.input_mean.push_back(mean);
    mlp.input_scale.push_back(scale);
  }
  std::tie(mlp.output_mean, mlp.output_scale) = mean_and_scale(samples.targets, 0, 1);
  return mlp;
}

}  // namespace

FitReport fit_network(const NetworkPreset& preset, const std::vector<Record>& training,
                      const std::string& drive_unit, const IdentifyOptions& options) {
  const TrainingSamples samples = training_samples(preset, training, drive_unit, options.offset);
  const std::size_t starts = static_cast<std::size_t>(std::max(1, options.starts));
  TrainOptions train_options;
  train_options.threads = options.threads;
  train_options.on_iteration = [&options](int, double) { options.monitor.check(); };
  std::vector<TrainedMlp> trained =
      train_from_starts(standardised(preset, samples), starts, options.seed, options.threads,
                        [&](Mlp& mlp) { return train(mlp, samples, train_options); });
  TrainedMlp& best = best_of(trained);

  FitReport report;
  report.status = best.report.converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
  report.message = best.report.converged ? "converged" : "iteration limit reached";
  report.iterations = best.report.iterations;
  report.training_rmse = best.report.rmse;
  report.model = std::make_shared<NetworkModel>(std::string(preset.name), preset.inputs, std::move(best.mlp));
  return report;
}

}  // namespace dashpot
