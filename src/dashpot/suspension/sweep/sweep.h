#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/base/part.h"
#include "dashpot/drive.h"
#include "dashpot/monitor.h"
#include "dashpot/suspension/sweep/draw.h"
#include "dashpot/suspension/sweep/store.h"

namespace dashpot {

struct SweepOptions {
  int threads = 0;
  Monitor monitor;
};

/// Every vehicle under every controller.
struct Sweep {
  SweepRequest request;
  std::vector<SweepDraw> vehicles;
  std::vector<std::vector<RideMeasures>> rides;  ///< by controller, then by vehicle
  /// What `current` is of: what drives the dampers; none: the controllers' differ.
  std::optional<DriveUnit> drive = DriveUnit::Ampere;
  std::string foot = "tyre";       ///< what the vehicle stands on, as foot_of()
  std::vector<std::string> notes;  ///< "the numbers of ... are an example: ..."
  std::size_t kept = 0;            ///< rides that were in the store before
  double wall_seconds = 0;

  std::size_t ride_count() const { return vehicles.size() * rides.size(); }
};

/// Drives the rides that are not in the store, in blocks that are kept as they end. The result is
/// the same bit for bit for any number of threads and interruptions. Throws Error naming the
/// vehicle that cannot be made, and Interrupted when the monitor stops it.
Sweep sweep(const SweepRequest& request, SweepStore& store, const SweepOptions& options);
/// Drives and keeps the blocks of one part of that sweep, and evaluates nothing: once all parts lie
/// in one store, sweep() finds its rides there. Counts blocks of vehicles.
PartReport sweep_part(const SweepRequest& request, SweepStore& store, const SweepOptions& options,
                      const Part& part);

}  // namespace dashpot
