#include "dashpot/damper/laws/plate_bingham_mixed.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kPlateBinghamMixed;
const Law kPlateBinghamMixed = static_law<PlateBinghamMixed, plate_bingham_mixed_force>({
    .name = "plate_bingham_mixed",
    .title = "Parallel plates, Bingham fluid, mixed mode",
    .equation = "F = sgn(v) (G + a (G / 2 + a / 12  N G / (G - f_y))) + f0,  N = c0 |v|\n"
                "3 (P - 2T)^2 (P^3 - (1 + 3T + a/2) P^2 + 4T^3) + T a^2 P^2 / 4 = 0,  P = G / N,  "
                "T = f_y / (2N)",
    .source = "Wereley, Pang 1998, Smart Mater. Struct. 7, 732-743, with drag and sign derived "
              "from the velocity profile; defaults: the example of plate_bingham",
    .remarks =
        "The gap's wall is the piston: it moves against the flow and drags. a = w h / A keeps its "
        "value in a fit, as the data hardly tell it from c0 and f_y, which are those of "
        "plate_bingham. No hysteresis. sgn(0) = 0. v_s > 0 makes the force smooth; it is not in "
        "the source and not fitted.",
    .states = {},
    .params =
        {
            {&PlateBinghamMixed::c0, "c0", "N*s/m", 1120, 0, 1e8, 0.3, Form::Linear,
             "damping of the flow without yield stress"},
            {&PlateBinghamMixed::f_y, "f_y", "N", 800, 0, 1e6, 0.4, Form::Quadratic,
             "force below which nothing flows (yield stress)"},
            {&PlateBinghamMixed::a, "a", "1", 0.12, 0, 1, 0.12, Form::Constant,
             "area of the gap over that of the piston", Fit::Fixed},
            {&PlateBinghamMixed::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant,
             "offset force (accumulator)", Fit::Bias},
            {&PlateBinghamMixed::v_s, "v_s", "m/s", 0, 0, 1, 0, Form::Constant,
             "speed over which the yield stress sets in; 0: at once", Fit::Fixed},
        },
    .needs_displacement = false,
    .dissipates = "Within the bounds: static, and against v at every speed.",
});

}  // namespace dashpot
