#include "dashpot/identify/fit/training_samples.h"

#include <cmath>

namespace dashpot {

TrainingSamples training_samples(const std::vector<Record>& records, DriveUnit drive_unit,
                                 OffsetMode offset, const InputRows& rows) {
  TrainingSamples samples;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const Record& record = records[r];
    const std::vector<double> inputs = rows(damper_inputs(record, drive_unit), record.time);
    const std::vector<double>& force = record.channel("force").samples;

    // Append inputs and forces from the end of the warm-up on.
    const auto warm_up = static_cast<std::ptrdiff_t>(record.warm_up);
    const auto width = static_cast<std::ptrdiff_t>(inputs.size() / force.size());
    samples.inputs.insert(samples.inputs.end(), inputs.begin() + warm_up * width, inputs.end());
    samples.targets.insert(samples.targets.end(), force.begin() + warm_up, force.end());
    if (offset == OffsetMode::Record) samples.group.resize(samples.targets.size(), r);
  }
  if (offset == OffsetMode::Record) samples.groups = records.size();
  return samples;
}

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

}  // namespace dashpot
