#include "dashpot/damper/laws/large_scale_bouc_wen.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kLargeScaleBoucWen;
const Law kLargeScaleBoucWen = with_travel<
    LargeScaleBoucWen, large_scale_bouc_wen_travel,
    large_scale_bouc_wen_filter>(state_law<LargeScaleBoucWen, large_scale_bouc_wen_force,
                                           large_scale_bouc_wen_derivative,
                                           large_scale_bouc_wen_rest, large_scale_bouc_wen_rate>({
    .name = "large_scale_bouc_wen",
    .title = "Large-scale Bouc-Wen (Yang)",
    .equation = "z' = A v - gamma |v| z |z|^(n-1) - beta v |z|^n\n"
                "v_f' = a = r (v - v_f)\n"
                "F = m a + a1 exp(-(a2 |v|)^p) v + k x + alpha z + f0",
    .source =
        "Yang, Spencer, Jung, Carlson 2004, J. Eng. Mech. 130, 1107-1114; the form is recalled, "
        "the defaults are an example of the 200 kN class, not published",
    .remarks = "The fluid's mass and shear thinning, which show in large dampers. The acceleration "
               "is that of the velocity behind a filter, whose rate is not fitted but follows the "
               "size of the data. A and n keep their values in a fit: z has no scale of its own.",
    .states = {{"z", "m"}, {"v_f", "m/s"}},
    .params =
        {
            {&LargeScaleBoucWen::m, "m", "kg", 2000, 0, 1e6, 0.01, Form::Constant,
             "equivalent mass of the fluid"},
            {&LargeScaleBoucWen::a1, "a1", "N*s/m", 2e6, 0, 1e9, 0.5, Form::Linear,
             "damping at low speed"},
            {&LargeScaleBoucWen::a2, "a2", "s/m", 50, 0, 1e6, 0.5, Form::Constant,
             "1 / a2 is the speed at which damping has fallen to 1/e"},
            {&LargeScaleBoucWen::p, "p", "1", 0.6, 0.3, 4, 0.6, Form::Constant,
             "how suddenly damping falls"},
            {&LargeScaleBoucWen::k, "k", "N/m", 8e4, -1e8, 1e8, 0, Form::Linear,
             "accumulator stiffness"},
            {&LargeScaleBoucWen::alpha, "alpha", "N/m", 1.2e6, 0, 1e9, 0.1, Form::Quadratic,
             "hysteresis gain"},
            {&LargeScaleBoucWen::gamma, "gamma", "1/m^2", 1e4, 1e-2, 1e12, 2, Form::Constant,
             "loop shape: multiplies |v| z"},
            {&LargeScaleBoucWen::beta, "beta", "1/m^2", 1e4, 0, 1e12, 2, Form::Constant,
             "loop shape: multiplies v |z|"},
            {&LargeScaleBoucWen::A, "A", "1", 200, 1e-3, 1e5, 120, Form::Constant,
             "loop slope: the scale of z", Fit::Fixed},
            {&LargeScaleBoucWen::n, "n", "1", 2, 1, 20, 2, Form::Constant, "sharpness of the knee",
             Fit::Fixed},
            {&LargeScaleBoucWen::r, "r", "1/s", 1000, 0.1, 1e5, 20, Form::Constant,
             "rate of the filter that gives the acceleration", Fit::Scale},
            {&LargeScaleBoucWen::f0, "f0", "N", -2000, -1e6, 1e6, 0, Form::Constant, "offset force",
             Fit::Bias},
        },
    .dissipates =
        "With m, a1, alpha >= 0, A > 0, gamma >= 0 and beta + gamma > 0, as bounded. The Bouc-Wen "
        "element as in bouc_wen; the mass, with v_f the filtered velocity and v - v_f = v_f' / r: "
        "m a v = (m v_f^2 / 2)' + m r (v - v_f)^2; the rest is static and against v, or a spring.",
}));

}  // namespace dashpot
