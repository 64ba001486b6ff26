#pragma once
#include <cstring>
#include <span>

namespace dashpot {

/// Values in table order as the struct of doubles whose fields stand in that order.
template <class P>
P sequence_values(std::span<const double> values) {
  P own;
  static_assert(sizeof own % sizeof(double) == 0);
  std::memcpy(&own, values.data(), sizeof own);
  return own;
}

}  // namespace dashpot
