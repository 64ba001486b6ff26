#include "dashpot/identify/fit/training_samples.h"

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

}  // namespace dashpot
