#pragma once
#include <string>
#include <vector>

#include "dashpot/damper/nets/free_run_record.h"
#include "dashpot/drive.h"
#include "dashpot/record.h"

// Records as the fits of models with states of their own take them, and figures of them.
namespace dashpot {

std::vector<FreeRunRecord> free_run_records(const std::vector<Record>& records,
                                            DriveUnit drive_unit);

/// The number of scored samples of all records.
std::size_t scored_samples(const std::vector<const FreeRunRecord*>& records);

/// Standard deviation of the scored force, N, each record's mean taken out; 1 for a force that
/// never changes.
double force_deviation(const std::vector<const FreeRunRecord*>& records);

/// The least and the greatest of the records' mean ways between two turns, m. A turn is a change of
/// direction at a tenth of the record's top speed at least, so that noise at rest is none.
struct WayRange {
  double shortest = 0, longest = 0;
};
WayRange way_range(const std::vector<const FreeRunRecord*>& records);

/// `count` rates in equal ratios from low to high; one alone stands in the middle.
std::vector<double> spaced_rates(double low, double high, std::size_t count);

}  // namespace dashpot
