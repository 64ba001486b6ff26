#include "dashpot/identify/fit/starting_bank.h"

#include "dashpot/identify/fit/free_run_records.h"

namespace dashpot {

HysteresisBank starting_bank(const BankSize& size, const std::vector<const FreeRunRecord*>& records,
                             bool drive_varies) {
  // Dahl rates times the longest and the shortest way.
  constexpr double kSlowest = 2, kFastest = 30;
  constexpr double kLags[] = {30, 300}, kCurrentLags[] = {20, 200}, kSteady = 100;  // 1/s
  const WayRange way = way_range(records);
  HysteresisBank bank;
  bank.path_rates = spaced_rates(kSlowest / way.longest, kFastest / way.shortest, size.path_states);
  bank.velocity_rates = spaced_rates(kLags[0], kLags[1], size.velocity_lags);
  bank.current_rates = drive_varies
                           ? spaced_rates(kCurrentLags[0], kCurrentLags[1], size.current_lags)
                           : std::vector{kSteady};
  return bank;
}

}  // namespace dashpot
