#pragma once
#include <vector>

#include "dashpot/damper/nets/free_run_record.h"
#include "dashpot/damper/nets/hysteresis_bank.h"

namespace dashpot {

struct BankSize {
  std::size_t path_states = 0, velocity_lags = 0;
  std::size_t current_lags = 0;  ///< one where the drive is steady
};

/// A bank whose rates cover what the records move: Dahl states by the ways between their turns.
HysteresisBank starting_bank(const BankSize& size, const std::vector<const FreeRunRecord*>& records,
                             bool drive_varies);

}  // namespace dashpot
