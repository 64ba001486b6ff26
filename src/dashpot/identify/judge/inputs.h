#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "dashpot/damper/model.h"
#include "dashpot/record/record.h"

// Records as a model sees them: motion and drive, and the ranges that they cover. drive_unit: "A"
// for a channel of current, "V" for one of voltage.
namespace dashpot {

/// The samples of the record's drive. Throws Error when it has no such channel.
const std::vector<double>& drive_samples(const Record& record, std::string_view drive_unit);

/// Motion and drive of the record, one per sample. Throws Error naming a missing channel; a record
/// without displacement gives 0 there.
std::vector<DamperInput> damper_inputs(const Record& record, std::string_view drive_unit);

/// The range of the drive in these records, A or V: all of it when it is constant in each, else the
/// middle 99 % of its samples, so that spikes at switching do not stretch the range.
struct DriveRange {
  double low = 0, high = 0;
  bool varies = false;     ///< within a record
  std::size_t levels = 0;  ///< distinct constant levels
};
DriveRange drive_range(const std::vector<Record>& records, std::string_view drive_unit);

/// The range of motion and drive in these records.
Domain domain_of(const std::vector<Record>& records, std::string_view drive_unit);

}  // namespace dashpot
