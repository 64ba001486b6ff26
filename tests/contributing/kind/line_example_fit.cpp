#include "contributing/kind/line_example_model.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/training_samples.h"

namespace dashpot {

FitReport fit_line_example(const LineExamplePreset&, const std::vector<Record>& training,
                           DriveUnit drive_unit, const IdentifyOptions& options) {
  const auto velocities = [](const std::vector<DamperInput>& inputs, const std::vector<double>&) {
    std::vector<double> values;
    for (const DamperInput& input : inputs) values.push_back(input.velocity);
    return values;
  };
  const TrainingSamples samples =
      training_samples(training, drive_unit, options.offset, velocities);

  // Least squares of one slope.
  double power = 0, square = 0;
  for (std::size_t k = 0; k < samples.targets.size(); ++k) {
    power += samples.inputs[k] * samples.targets[k];
    square += samples.inputs[k] * samples.inputs[k];
  }
  FitReport report;
  report.status = FitReport::Status::Converged;
  report.model = std::make_shared<LineExampleModel>(square > 0 ? power / square : 0, 0);
  return report;
}

}  // namespace dashpot
