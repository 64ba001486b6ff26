#pragma once
#include <cmath>
#include <cstddef>

namespace dashpot {

/// Counts how often a signal passes to a side of its middle, the first time included. Within the
/// band around the middle it stays on the side on which it was.
struct SidePasses {
  double middle = 0, band = 0;  ///< of the signal's unit
  std::size_t count = 0;
  int side = 0;  ///< 1 above, -1 below, 0 not yet known

  void see(double value) {
    const double off = value - middle;
    const int now = std::abs(off) <= band ? side : off > 0 ? 1 : -1;
    count += now != side;
    side = now;
  }
};

}  // namespace dashpot
