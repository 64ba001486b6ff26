#pragma once
#include <cstdint>
#include <vector>

#include "dashpot/design/design_problem.h"
#include "dashpot/monitor.h"

namespace dashpot {

/// How the tolerances change the figures of one design: the goals, then the constraints. SI.
struct Sensitivity {
  struct Figure {
    double drawn = 0, low = 0, high = 0;  ///< as drawn; between which 90 % of the dampers made lie
    std::vector<double> local;            ///< derivative times tolerance, of each tolerance
    /// Shares of the variance: alone (first order), and with all it takes part in (total), Saltelli
    /// 2010 and Jansen 1999. They are estimates: small ones may come out a little below 0.
    std::vector<double> alone, total;
  };
  std::vector<Figure> figures;
  double holding = 1;  ///< share of the dampers made that hold every constraint
};

struct SensitivityOptions {
  std::size_t samples = 512;
  std::size_t ridden = 48;  ///< samples of figures that need a ride
  std::uint64_t seed = 1;
  int threads = 0;  ///< results do not depend on it
};

/// A figure that is not finite for some damper made has no shares (NaN).
Sensitivity sensitivity(const DesignProblem& problem, const DamperDescription& design,
                        const SensitivityOptions& options);

}  // namespace dashpot
