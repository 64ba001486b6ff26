#include "dashpot/identify/starting_bank.h"

#include <algorithm>
#include <cmath>

namespace dashpot {
namespace {

std::vector<double> spaced(double low, double high, std::size_t count) {
  std::vector<double> rates(count, std::sqrt(low * high));
  for (std::size_t k = 0; count > 1 && k < count; ++k)
    rates[k] = low * std::pow(high / low, static_cast<double>(k) / static_cast<double>(count - 1));
  return rates;
}

/// Mean way between two turns, m. A turn is a change of direction at a tenth of the record's top speed at
/// least, so that noise at rest is none.
double mean_way(const BankRecord& record) {
  double top = 0, way = 0;
  for (const DamperInput& input : record.inputs) top = std::max(top, std::abs(input.velocity));
  int turns = 0, direction = 0;
  for (std::size_t k = 1; k < record.inputs.size(); ++k) {
    const double v = record.inputs[k].velocity;
    way += std::abs(v) * (record.time[k] - record.time[k - 1]);
    const int now = v > 0 ? 1 : -1;
    if (std::abs(v) <= 0.1 * top || now == direction) continue;
    direction = now;
    ++turns;
  }
  return way / std::max(1, turns);
}

}  // namespace

HysteresisBank starting_bank(const BankSize& size, const std::vector<const BankRecord*>& records,
                             bool drive_varies) {
  constexpr double kSlowest = 2, kFastest = 30;  // Dahl rates times the longest and the shortest way
  constexpr double kLags[] = {30, 300}, kCurrentLags[] = {20, 200}, kSteady = 100;  // 1/s
  double shortest = INFINITY, longest = 0;
  for (const BankRecord* record : records) {
    const double way = mean_way(*record);
    shortest = std::min(shortest, way);
    longest = std::max(longest, way);
  }
  HysteresisBank bank;
  bank.path_rates = spaced(kSlowest / longest, kFastest / shortest, size.path_states);
  bank.velocity_rates = spaced(kLags[0], kLags[1], size.velocity_lags);
  bank.current_rates =
      drive_varies ? spaced(kCurrentLags[0], kCurrentLags[1], size.current_lags) : std::vector{kSteady};
  return bank;
}

}  // namespace dashpot
