#include "dashpot/identify/fit/free_run_records.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dashpot/evaluate.h"
#include "dashpot/identify/judge/stroke.h"

namespace dashpot {
std::vector<FreeRunRecord> free_run_records(const std::vector<Record>& records,
                                            DriveUnit drive_unit) {
  std::vector<FreeRunRecord> all;
  for (const Record& record : records)
    all.push_back({damper_inputs(record, drive_unit), record.time, record.channel("force").samples,
                   record.warm_up});
  return all;
}

std::size_t scored_samples(const std::vector<const FreeRunRecord*>& records) {
  std::size_t samples = 0;
  for (const FreeRunRecord* record : records) samples += record->inputs.size() - record->first;
  return samples;
}

double force_deviation(const std::vector<const FreeRunRecord*>& records) {
  double squares = 0, samples = 0;
  for (const FreeRunRecord* record : records) {
    const auto first = record->force.begin() + static_cast<std::ptrdiff_t>(record->first);
    const double n = static_cast<double>(record->force.end() - first);
    const double sum = std::accumulate(first, record->force.end(), 0.0);
    squares += std::inner_product(first, record->force.end(), first, 0.0) - sum * sum / n;
    samples += n;
  }
  const double deviation = std::sqrt(std::max(0.0, squares) / samples);
  return deviation > 0 ? deviation : 1;
}

WayRange way_range(const std::vector<const FreeRunRecord*>& records) {
  WayRange range{INFINITY, 0};
  for (const FreeRunRecord* record : records) {
    const double way = mean_stroke(record->inputs, record->time).way;
    range.shortest = std::min(range.shortest, way);
    range.longest = std::max(range.longest, way);
  }
  return range;
}

std::vector<double> spaced_rates(double low, double high, std::size_t count) {
  std::vector<double> rates(count, std::sqrt(low * high));
  for (std::size_t k = 0; count > 1 && k < count; ++k)
    rates[k] = low * std::pow(high / low, static_cast<double>(k) / static_cast<double>(count - 1));
  return rates;
}

}  // namespace dashpot
