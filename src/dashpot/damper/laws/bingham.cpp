#include "dashpot/damper/laws/bingham.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kBingham;
const Law kBingham = static_law<Bingham, bingham_force>({
    .name = "bingham",
    .title = "Bingham",
    .equation = "F = c0 v + f_c sgn(v) + f0",
    .source = "Stanway, Sproston, Stevens 1987, J. Electrostatics 20, 167-184; defaults: example "
              "values of the fixed-voltage fit in Spencer et al. 1997, recalled, not verified",
    .remarks =
        "Two parameters that matter, no hysteresis: the low-speed loop is missing. sgn(0) = 0. v_s "
        "> 0 replaces sgn(v) by tanh(v / v_s) for solvers that need a smooth force; it is not in "
        "the source and not fitted.",
    .states = {},
    .params =
        {
            {&Bingham::c0, "c0", "N*s/m", 5000, 0, 1e8, 0.4, Form::Linear, "viscous damping"},
            {&Bingham::f_c, "f_c", "N", 670, 0, 1e6, 0.5, Form::Quadratic,
             "friction force (yield stress)"},
            {&Bingham::f0, "f0", "N", -95, -1e6, 1e6, 0, Form::Constant,
             "offset force (accumulator)", Fit::Bias},
            {&Bingham::v_s, "v_s", "m/s", 0, 0, 1, 0, Form::Constant,
             "speed over which friction sets in; 0: at once", Fit::Fixed},
        },
    .needs_displacement = false,
    .dissipates = "Within the bounds: static, and against v at every speed.",
});

}  // namespace dashpot
