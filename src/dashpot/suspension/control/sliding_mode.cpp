#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/suspension/control/damping_law.h"

namespace dashpot {

#include "dashpot/suspension/control/c_text/control_sliding_mode.h"

extern const ControlLaw kSlidingMode;

namespace {

/// kg, of what a force on the strut's upper end moves: 1 / (r M^-1 r).
double mass_above(const Plant& plant, const Strut& strut) {
  const std::vector<double> moved = solve(plant.mass, strut.body_row);
  double mobility = 0;
  for (std::size_t k = 0; k < moved.size(); ++k) mobility += strut.body_row[k] * moved[k];
  return 1 / mobility;
}

ControllerPointer make_sliding_mode(std::span<const double> values, const ControlContext& context) {
  // Mass and stiffness that are not stated are those at the first strut.
  SlidingMode p{values[0], values[1], values[2], values[3], values[4], context.limits.sample_time};
  const Plant& plant = context.plant;
  if (p.mass == 0) p.mass = plant.struts.empty() ? 1 : mass_above(plant, plant.struts[0]);
  if (p.stiffness == 0) p.stiffness = strut_stiffness(plant);
  return std::make_unique<StrutLaw<kSlidingMode, SlidingMode, sliding_mode_demand, 1>>(p, context);
}

}  // namespace

const ControlLaw kSlidingMode{
    .name = "sliding_mode",
    .title = "Sliding mode, after a body under a skyhook damper",
    .equation = "F = C w + m n sat((z' - w) / b), within c_min d ... c_max d;  m w' = -k x - C w",
    .source =
        "Yokoyama, Hedrick and Toyama, American Control Conference 2001, recalled: a model that is "
        "followed in velocity, without their surface's displacement",
    .remarks = "Dong, Yu, Li and Chen, Nonlinear Dynamics 59 (2010) 433, compare a sliding mode.",
    .parameters = {{"damping", "N*s/m", 3000, 0, 1e7, "C, of the skyhook damper that is followed"},
                   {"reaching", "m/s^2", 2, 0, 1e4, "n, with which the body nears the model"},
                   {"layer", "m/s", 0.1, 1e-6, 100, "b, about the surface, against chatter"},
                   {"mass", "kg", 0, 0, 1e7, "m, of the body; 0: what the first strut bears"},
                   {"stiffness", "N/m", 0, 0, 1e9, "k, of the suspension; 0: the first strut's"}},
    .make = make_sliding_mode};

}  // namespace dashpot
