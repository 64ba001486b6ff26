#include "dashpot/damper/laws/bouc_wen.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kBoucWen;
const Law kBoucWen = with_travel<BoucWen, bouc_wen_travel>(
    state_law<BoucWen, bouc_wen_force, bouc_wen_derivative, bouc_wen_rest, bouc_wen_rate>({
        .name = "bouc_wen",
        .title = "Bouc-Wen",
        .equation = "z' = A v - gamma |v| z |z|^(n-1) - beta v |z|^n\n"
                    "F = c0 v + k0 (x - x0) + alpha z + f0",
        .source =
            "Wen 1976, J. Eng. Mech. Div. 102, 249-263, as in Spencer, Dyke, Sain, Carlson 1997; "
            "defaults: its fixed-voltage fit, recalled, not verified, with x0 = 0",
        .remarks =
            "z has no scale of its own: of alpha, A, gamma and beta only three numbers are "
            "independent, so A keeps its value in a fit, as do n and x0 (k0 x0 is a constant "
            "force, which f0 holds). The force does not roll off at low speed as a damper's does: "
            "modified_bouc_wen adds that. Loops that harden need beta < 0: "
            "examples/laws/hardening_bouc_wen.yaml.",
        .states = {{"z", "m"}},
        .params =
            {
                {&BoucWen::alpha, "alpha", "N/m", 88000, 0, 1e9, 0.1, Form::Quadratic,
                 "hysteresis gain"},
                {&BoucWen::c0, "c0", "N*s/m", 5000, 0, 1e8, 0.3, Form::Linear, "viscous damping"},
                {&BoucWen::k0, "k0", "N/m", 2500, -1e8, 1e8, 0, Form::Linear, "stiffness"},
                {&BoucWen::x0, "x0", "m", 0, -10, 10, 0, Form::Constant,
                 "where the spring is relaxed", Fit::Fixed},
                {&BoucWen::gamma, "gamma", "1/m^2", 1e6, 1e-2, 1e12, 2, Form::Constant,
                 "loop shape: multiplies |v| z"},
                {&BoucWen::beta, "beta", "1/m^2", 1e6, 0, 1e12, 2, Form::Constant,
                 "loop shape: multiplies v |z|"},
                {&BoucWen::A, "A", "1", 120, 1e-3, 1e5, 120, Form::Constant,
                 "loop slope: the scale of z", Fit::Fixed},
                {&BoucWen::n, "n", "1", 2, 1, 20, 2, Form::Constant, "sharpness of the knee",
                 Fit::Fixed},
                {&BoucWen::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant, "offset force",
                 Fit::Bias},
            },
        .dissipates = "With alpha, c0 >= 0, A > 0, gamma >= 0 and beta + gamma > 0, as bounded: S "
                      "= alpha times the integral of z / (A - (beta - gamma) |z|^n) over z is "
                      "stored; where z returns to 0 all of it comes back, and where |z| grows "
                      "alpha z v - S' = alpha z v 2 gamma |z|^n / (A - (beta - gamma) |z|^n) >= 0 "
                      "is lost. The spring k0 stores what it takes, whatever its sign.",
    }));

}  // namespace dashpot
