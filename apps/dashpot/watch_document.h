#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/watch.h"
#include "dashpot/report/document.h"

namespace dashpot::cli {

/// A watched plant as it is shown: its days in their order, and the charts of them.
struct Watched {
  const WatchedPlant& plant;
  const std::vector<WatchedDay>& days;
  const std::vector<WatchedQuantity>& quantities;
  const WatchOptions& options;

  /// The quantity whose alarm came first; null: none has.
  const WatchedQuantity* first_alarm() const;
  /// "the damper's whole force has fallen by 12 +- 3 % since ..."
  std::string alarm_text(const WatchedQuantity& quantity) const;
};

/// Verdict, the days as a table, the charts, and all of it as JSON.
Document watch_document(const Watched& watched);
/// A row per day, SI.
std::string watch_csv(const Watched& watched);

}  // namespace dashpot::cli
