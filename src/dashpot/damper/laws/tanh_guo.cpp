#include "dashpot/damper/laws/tanh_guo.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kTanhGuo;
const Law kTanhGuo = static_law<TanhGuo, tanh_guo_force>({
    .name = "tanh_guo",
    .title = "Hyperbolic tangent of velocity and position (Guo)",
    .equation = "F = A1 tanh(A3 w) + A2 w + f0, w = v + (V0 / X0) x",
    .source = "Guo, Yang, Pan 2006, J. Intell. Mater. Syst. Struct. 17, 3-14, form recalled; "
              "defaults: an example of our own",
    .remarks = "Algebraic and smooth. Assumes a motion centred on x = 0. Only V0 / X0 matters, so "
               "X0 takes the stroke of the data.",
    .states = {},
    .params =
        {
            {&TanhGuo::A1, "A1", "N", 1200, 0, 1e6, 0.5, Form::Quadratic, "yield force"},
            {&TanhGuo::A2, "A2", "N*s/m", 1500, 0, 1e8, 0.4, Form::Linear, "damping after yield"},
            {&TanhGuo::A3, "A3", "s/m", 30, 1e-3, 1e6, 10, Form::Constant, "slope before yield"},
            {&TanhGuo::V0, "V0", "m/s", 0.05, -10, 10, 0.03, Form::Constant,
             "critical velocity of the hysteresis"},
            {&TanhGuo::X0, "X0", "m", 0.02, 1e-6, 10, 1, Form::Constant,
             "critical displacement of the hysteresis", Fit::Scale},
            {&TanhGuo::f0, "f0", "N", 40, -1e6, 1e6, 0, Form::Constant, "offset force", Fit::Bias},
        },
    .dissipates =
        "Within the bounds: at every x the force rises with v; what it has at v = 0 is a spring's.",
});

}  // namespace dashpot
