#include "dashpot/damper/kinds/narx/presets.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/kinds/network/presets.h"
#include "dashpot/damper/nets/standardise.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/network_trainer.h"
#include "dashpot/identify/fit/training_samples.h"

namespace dashpot {
namespace {

double input_of(const DamperInput& input, std::string_view name) {
  if (name == "displacement") return input.displacement;
  return name == "velocity" ? input.velocity : input.current;
}

}  // namespace

FitReport fit_network(const NetworkPreset& preset, const std::vector<Record>& training,
                      DriveUnit drive_unit, const IdentifyOptions& options) {
  // A network that also reads past inputs is a NARX model.
  if (options.network.delays.value_or(0) > 0)
    return fit_narx(narx_preset(preset), training, drive_unit, options);

  // The samples: present inputs, one row per instant.
  const auto rows = [&](const std::vector<DamperInput>& inputs, const std::vector<double>&) {
    std::vector<double> values;
    for (const DamperInput& input : inputs)
      for (const std::string& name : preset.inputs) values.push_back(input_of(input, name));
    return values;
  };
  const SamplesOf samples_of = [&](const std::vector<Record>& records) {
    return training_samples(records, drive_unit, options.offset, rows);
  };

  // Train the members.
  const NetworkDesign& design = options.network;
  const Mlp start =
      untrained(preset.inputs.size(), design.hidden.empty() ? preset.hidden : design.hidden,
                design.activation.value_or(Activation::Tanh), samples_of(training));
  TrainedEnsemble trained = train_networks(start, training, samples_of, options);

  FitReport report;
  report.status = trained.status;
  report.message = trained.message;
  report.iterations = trained.iterations;
  report.training_rmse = trained.rmse;
  if (trained.status == FitReport::Status::Failed) return report;
  report.model = std::make_shared<NetworkModel>(std::string(preset.name), preset.inputs,
                                                std::move(trained.members));
  return report;
}

}  // namespace dashpot
