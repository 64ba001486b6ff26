#include "dashpot/damper/laws/extended_bingham.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kExtendedBingham;
const Law kExtendedBingham = with_step<ExtendedBingham, extended_bingham_step>(
    state_law<ExtendedBingham, extended_bingham_force, extended_bingham_derivative,
              extended_bingham_rest, extended_bingham_rate>({
        .name = "extended_bingham",
        .title = "Extended Bingham (viscoelastic-plastic)",
        .equation = "g = k2 (x - x2)\n"
                    "x1' = 0 where |g| <= f_c, else (g - f_c sgn g) / c0\n"
                    "x2' = x1' + (g - k1 (x2 - x1)) / c1\n"
                    "F = g + f0",
        .source = "Gamota, Filisko 1991, J. Rheology 35, 399-425, in the form of Spencer, Dyke, "
                  "Sain, Carlson 1997; defaults: an example of the 1 kN class, not published",
        .remarks =
            "Bingham with an elastic stretch before yield. Follows the displacement alone. Before "
            "yield only the springs and c1 count, after it c0 and f_c: records need both.",
        .states = {{"x1", "m"}, {"x2", "m"}},
        .params =
            {
                {&ExtendedBingham::c0, "c0", "N*s/m", 5000, 1e-2, 1e9, 0.4, Form::Linear,
                 "damping after yield"},
                {&ExtendedBingham::f_c, "f_c", "N", 300, 0, 1e6, 0.5, Form::Quadratic,
                 "yield force"},
                {&ExtendedBingham::c1, "c1", "N*s/m", 20000, 1e-2, 1e10, 2, Form::Constant,
                 "damping of the solid"},
                {&ExtendedBingham::k1, "k1", "N/m", 1e5, 0, 1e11, 5, Form::Constant,
                 "stiffness of the solid"},
                {&ExtendedBingham::k2, "k2", "N/m", 2e5, 1, 1e11, 15, Form::Constant,
                 "stiffness of the spring"},
                {&ExtendedBingham::f0, "f0", "N", -50, -1e6, 1e6, 0, Form::Constant, "offset force",
                 Fit::Bias},
            },
        .dissipates = "Within the bounds: springs store, dashpots and friction lose, in "
                      "series and side by side.",
    }));

}  // namespace dashpot
