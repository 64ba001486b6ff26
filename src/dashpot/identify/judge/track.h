#pragma once
#include <vector>

#include "dashpot/damper/inverse/inverse.h"
#include "dashpot/damper/inverse/wanted.h"
#include "dashpot/driver.h"
#include "dashpot/evaluate.h"

namespace dashpot {

/// The force that an inverse obtained for a wanted one, sample by sample.
struct TrackReport {
  std::vector<double> time, wanted, obtained;  ///< s, N, N
  std::vector<double> command, current;        ///< A
  std::vector<double> least, greatest;  ///< N, what any current would have given at that instant
  std::size_t warm_up = 0;  ///< first samples, not scored: the coil starts without current

  double span = 0;             ///< N, of the wanted force
  Metrics all, reachable;      ///< obtained against wanted; where the wanted force lay in reach
  double reachable_share = 0;  ///< %, of the scored time
  double saturated_share = 0;  ///< %, of the scored time: the command at a limit
  bool is_reachable(std::size_t k) const;
  double error(std::size_t k) const { return obtained[k] - wanted[k]; }
};

/// The least and the greatest current, the sample time and the lag that an inverse in front of this
/// driver must know.
InverseLimits limits_of(const DriverOptions& driver, double sample_time);

/// The driver with the damper's own coil lag, when it has one and the options state none.
DriverOptions driver_of(const DamperModel& damper, DriverOptions options);

/// Damper, driver and inverse along a motion. A coil lag of the damper's own is left out: it is the
/// driver's (driver_of). Throws Error when motion and wanted force differ in length.
TrackReport track(const DamperModel& damper, const InverseModel& inverse, const Driver& driver,
                  const Motion& motion, const std::vector<double>& wanted);

}  // namespace dashpot
