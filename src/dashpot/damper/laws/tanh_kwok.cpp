#include "dashpot/damper/laws/tanh_kwok.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kTanhKwok;
const Law kTanhKwok = static_law<TanhKwok, tanh_kwok_force>({
    .name = "tanh_kwok",
    .title = "Hyperbolic tangent (Kwok)",
    .equation = "F = c v + k x + alpha tanh(beta v + delta sgn(x)) + f0",
    .source = "Kwok, Ha, Nguyen, Li, Samali 2006, Sensors and Actuators A 132, 441-451; defaults: "
              "its example set at 1 A, recalled, not verified",
    .remarks =
        "Algebraic, fast, smooth in speed. Assumes a motion centred on x = 0 (subtract the mean "
        "stroke); the force jumps where the stroke crosses zero. k may be negative. sgn(0) = 0.",
    .states = {},
    .params =
        {
            {&TanhKwok::c, "c", "N*s/m", 3161, 0, 1e8, 0.4, Form::Linear, "viscous damping"},
            {&TanhKwok::k, "k", "N/m", 3400, -1e8, 1e8, 0, Form::Linear, "stiffness"},
            {&TanhKwok::alpha, "alpha", "N", 706, 0, 1e6, 0.5, Form::Quadratic,
             "height of the hysteresis"},
            {&TanhKwok::beta, "beta", "s/m", 100, 1e-3, 1e6, 10, Form::Constant,
             "steepness of the hysteresis"},
            {&TanhKwok::delta, "delta", "1", 0.88, -10, 10, 0.3, Form::Linear,
             "half width of the hysteresis, in beta v"},
            {&TanhKwok::f0, "f0", "N", 39, -1e6, 1e6, 0, Form::Constant, "offset force", Fit::Bias},
        },
    .dissipates = "Within the bounds: at every x the force rises with v; what it has at v = 0 is a "
                  "spring's, which leaps by 2 alpha tanh(delta) at x = 0: a solver's step across "
                  "it may do work, the law does not.",
});

}  // namespace dashpot
