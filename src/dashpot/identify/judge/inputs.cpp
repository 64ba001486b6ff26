#include "dashpot/identify/judge/inputs.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "dashpot/base/error.h"

namespace dashpot {

const std::vector<double>& drive_samples(const Record& record, std::string_view drive_unit) {
  const std::string_view name = drive_unit == "V" ? "voltage" : "current";
  if (const Channel* drive = record.find(name)) return drive->samples;
  throw Error(record.name, "has no known " + std::string(name),
              "give it as a column, in the file name (run_0.5" + std::string(drive_unit) +
                  ".csv), in manifest.csv or in a dataset file");
}

std::vector<DamperInput> damper_inputs(const Record& record, std::string_view drive_unit) {
  const std::vector<double>& velocity = record.channel("velocity").samples;
  const std::vector<double>& drive = drive_samples(record, drive_unit);
  const Channel* displacement = record.find("displacement");
  std::vector<DamperInput> inputs(record.size());
  for (std::size_t k = 0; k < inputs.size(); ++k)
    inputs[k] = {displacement ? displacement->samples[k] : 0.0, velocity[k], drive[k]};
  return inputs;
}

DriveRange drive_range(const std::vector<Record>& records, std::string_view drive_unit) {
  DriveRange range;
  std::vector<double> samples, levels;
  for (const Record& record : records) {
    const std::vector<double>& drive = drive_samples(record, drive_unit);
    samples.insert(samples.end(), drive.begin(), drive.end());
    if (record.drive_level)
      levels.push_back(*record.drive_level);
    else
      range.varies = true;
  }
  if (samples.empty()) return range;

  std::sort(samples.begin(), samples.end());
  std::sort(levels.begin(), levels.end());
  range.levels =
      static_cast<std::size_t>(std::unique(levels.begin(), levels.end()) - levels.begin());

  // Half a per cent at either end is left out where the drive varies.
  const std::size_t margin = range.varies ? samples.size() / 200 : 0;
  range.low = samples[margin];
  range.high = samples[samples.size() - 1 - margin];
  return range;
}

Domain domain_of(const std::vector<Record>& records, std::string_view drive_unit) {
  const DriveRange drive = drive_range(records, drive_unit);
  Domain domain{INFINITY, -INFINITY, INFINITY, -INFINITY, drive.low, drive.high};
  for (const Record& record : records)
    for (const DamperInput& input : damper_inputs(record, drive_unit)) {
      domain.displacement_min = std::min(domain.displacement_min, input.displacement);
      domain.displacement_max = std::max(domain.displacement_max, input.displacement);
      domain.velocity_min = std::min(domain.velocity_min, input.velocity);
      domain.velocity_max = std::max(domain.velocity_max, input.velocity);
    }
  return domain;
}

}  // namespace dashpot
