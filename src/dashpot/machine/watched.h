#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/watch.h"

namespace dashpot {

/// A watched plant, its days in their order, and the charts of them.
struct Watched {
  const WatchedPlant& plant;
  const std::vector<WatchedDay>& days;
  const std::vector<WatchedQuantity>& quantities;
  const WatchOptions& options;
  std::vector<std::string> left_out = {};  ///< why a recording is no day, a sentence each

  /// As first_alarm_of().
  const WatchedQuantity* first_alarm() const;
  bool is_judged(std::size_t day) const;
  /// What is to be said of a day: "ALARM: force", "reference", "does not count: not converged".
  std::string remark(std::size_t day) const;
};

/// What `dashpot watch --json` prints.
Value to_json(const Watched& watched);

}  // namespace dashpot
