#include "dashpot/damper/laws/plate_bingham.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kPlateBingham;
const Law kPlateBingham = static_law<PlateBingham, plate_bingham_force>({
    .name = "plate_bingham",
    .title = "Parallel plates, Bingham fluid, valve mode",
    .equation = "F = sgn(v) G + f0\n"
                "G^3 - (c0 |v| + 3/2 f_y) G^2 + f_y^3 / 2 = 0, largest root",
    .source = "Phillips 1969, thesis, UC Berkeley; Wereley, Pang 1998, Smart Mater. Struct. 7, "
              "732-743; defaults: 0.28 Pa s and 20 kPa in a gap of 0.5 mm, 20 mm long, 0.12 m "
              "wide, piston 500 mm^2: an example",
    .remarks =
        "Geometry and fluid enter through two numbers, c0 = 12 eta L A^2 / (w h^3) and f_y = 2 tau "
        "L A / h: with the geometry known they give viscosity and yield stress. No hysteresis. "
        "sgn(0) = 0. v_s > 0 makes the force smooth; it is not in the source and not fitted.",
    .states = {},
    .params =
        {
            {&PlateBingham::c0, "c0", "N*s/m", 1120, 0, 1e8, 0.3, Form::Linear,
             "damping without yield stress"},
            {&PlateBingham::f_y, "f_y", "N", 800, 0, 1e6, 0.4, Form::Quadratic,
             "force below which nothing flows (yield stress)"},
            {&PlateBingham::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant,
             "offset force (accumulator)", Fit::Bias},
            {&PlateBingham::v_s, "v_s", "m/s", 0, 0, 1, 0, Form::Constant,
             "speed over which the yield stress sets in; 0: at once", Fit::Fixed},
        },
    .needs_displacement = false,
    .dissipates = "Within the bounds: static, and against v at every speed.",
});

}  // namespace dashpot
