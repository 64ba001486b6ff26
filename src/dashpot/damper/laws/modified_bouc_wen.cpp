#include "dashpot/damper/laws/modified_bouc_wen.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kModifiedBoucWen;
const Law kModifiedBoucWen =
    with_step<ModifiedBoucWen, modified_bouc_wen_step>(
        state_law<ModifiedBoucWen, modified_bouc_wen_force, modified_bouc_wen_derivative,
                  modified_bouc_wen_rest, modified_bouc_wen_rate>(
            {
                .name = "modified_bouc_wen",
                .title = "Modified Bouc-Wen (Spencer)",
                .equation = "y' = (alpha z + c0 v + k0 (x - y)) / (c0 + c1)\n"
                            "z' = A (v - y') - gamma |v - y'| z |z|^(n-1) - beta (v - y') |z|^n\n"
                            "F = c1 y' + k1 (x - x0) + f0",
                .source = "Spencer, Dyke, Sain, Carlson 1997, J. Eng. Mech. 123, 230-238; "
                          "defaults: its prototype damper at 1.5 V, with x0 = 0",
                .remarks = "z has no scale of its own: of alpha, A, gamma and beta only three "
                           "numbers are independent, so A keeps its value in a fit; alpha A, gamma "
                           "A and beta A compare sets with different A (n = 2), and ((gamma + "
                           "beta) A)^(-1/2) is the knee in m. n and x0 keep theirs too: k1 x0 is a "
                           "constant force, which f0 holds (the source has f0 = 0 and x0 = 0.143 "
                           "m). beta multiplies w |z|^n; some papers call that gamma. The lag is "
                           "that of the source's voltage-driven coil.",
                .states = {{"y", "m"}, {"z", "m"}},
                .params =
                    {
                        {&ModifiedBoucWen::alpha, "alpha", "N/m", 118250, 0, 1e9, 0.25,
                         Form::Quadratic, "hysteresis gain"},
                        {&ModifiedBoucWen::c0, "c0", "N*s/m", 2625, 0, 1e8, 0.3, Form::Linear,
                         "damping at high speed"},
                        {&ModifiedBoucWen::c1, "c1", "N*s/m", 28742.5, 0.1, 1e10, 5, Form::Linear,
                         "damping in series: the roll-off at low speed", Fit::Rises},
                        {&ModifiedBoucWen::k0, "k0", "N/m", 4690, 0, 1e8, 0.05, Form::Constant,
                         "stiffness at high speed"},
                        {&ModifiedBoucWen::k1, "k1", "N/m", 500, 0, 1e8, 0.02, Form::Constant,
                         "accumulator stiffness"},
                        {&ModifiedBoucWen::x0, "x0", "m", 0, -10, 10, 0, Form::Constant,
                         "where the accumulator spring is relaxed", Fit::Fixed},
                        {&ModifiedBoucWen::gamma, "gamma", "1/m^2", 3.63e6, 1e-2,
                         1e12, 16, Form::Constant, "loop shape: multiplies |w| z"},
                        {&ModifiedBoucWen::beta, "beta", "1/m^2", 3.63e6, 0, 1e12,
                         16, Form::Constant, "loop shape: multiplies w |z|"},
                        {&ModifiedBoucWen::A, "A", "1", 301, 1e-3, 1e5, 301, Form::Constant,
                         "loop slope: the scale of z", Fit::Fixed},
                        {&ModifiedBoucWen::n, "n", "1", 2, 1, 20, 2, Form::Constant,
                         "sharpness of the knee", Fit::Fixed},
                        {&ModifiedBoucWen::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant,
                         "offset force", Fit::Bias},
                    },
                .lag_rate = 190,
                .dissipates = "Within the bounds (springs, dashpots and alpha >= 0, A > 0, gamma "
                              ">= 0, beta + gamma > 0): springs and dashpots in series and side by "
                              "side with a Bouc-Wen element, which dissipates as in bouc_wen.",
            }));

}  // namespace dashpot
