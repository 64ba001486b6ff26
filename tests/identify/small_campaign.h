#pragma once
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/drive.h"

namespace dashpot {

struct SmallCampaign {
  std::vector<double> drive_levels = {0, 1};  ///< A
  double sample_rate = 100;                   ///< Hz
};

/// A cycle of each motion at each current, of a damper of the literature with hysteresis and a
/// knee; no noise.
inline Dataset small_campaign(std::vector<SineMotion> motions, const SmallCampaign& options = {}) {
  BenchOptions bench;
  bench.motions = std::move(motions);
  bench.drive_levels = options.drive_levels;
  bench.sample_rate = options.sample_rate;
  bench.cycles = 1;
  bench.force_noise = 0;
  return run_virtual_bench(load_parameters("kwok2006"), DriveUnit::Ampere, bench);
}

}  // namespace dashpot
