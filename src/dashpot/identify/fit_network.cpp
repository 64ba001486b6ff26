#include <algorithm>
#include <tuple>

#include "dashpot/damper/neural/ensemble.h"
#include "dashpot/damper/neural/network_model.h"
#include "dashpot/identify/fit.h"
#include "dashpot/identify/training_samples.h"

namespace dashpot {
namespace {

double input_of(const DamperInput& input, std::string_view name) {
  if (name == "displacement") return input.displacement;
  return name == "velocity" ? input.velocity : input.current;
}

Mlp standardised(const NetworkPreset& preset, const NetworkDesign& design, const TrainingSamples& samples) {
  const std::vector<std::size_t>& hidden = design.hidden.empty() ? preset.hidden : design.hidden;
  Mlp mlp;
  mlp.layers.push_back(preset.inputs.size());
  mlp.layers.insert(mlp.layers.end(), hidden.begin(), hidden.end());
  mlp.layers.push_back(1);
  mlp.activations.assign(hidden.size(), design.activation.value_or(Activation::Tanh));
  mlp.activations.push_back(Activation::Identity);
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
  const auto rows = [&](const std::vector<DamperInput>& inputs, const std::vector<double>&) {
    std::vector<double> values;
    for (const DamperInput& input : inputs)
      for (const std::string& name : preset.inputs) values.push_back(input_of(input, name));
    return values;
  };
  const TrainingSamples samples = training_samples(training, drive_unit, options.offset, rows);
  const std::size_t starts = static_cast<std::size_t>(std::max(1, options.starts));
  TrainOptions train_options;
  train_options.threads = options.threads;
  train_options.on_iteration = [&options](int, double) { options.monitor.check(); };
  std::vector<TrainedMlp> trained =
      train_from_starts(standardised(preset, options.network, samples), starts, options.seed, options.threads,
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
