#include "dashpot/damper/laws/semi_phenomenological.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kSemiPhenomenological;
const Law kSemiPhenomenological = static_law<SemiPhenomenological, semi_phenomenological_force>({
    .name = "semi_phenomenological",
    .title = "Semi-phenomenological (Lozoya, Poussot-Vassal)",
    .equation = "F = alpha tanh(a1 v + a2 x) + b1 v + b2 x + f0",
    .source =
        "Guo, Yang, Pan 2006, J. Intell. Mater. Syst. Struct. 17, 3-14; the one-sensor paper; "
        "defaults: a set of Lozoya-Santos et al. at 1 A, recalled, not verified",
    .remarks = "Algebraic and smooth: a favourite of controllers. alpha is linear in current "
               "unless told otherwise. Assumes a motion centred on x = 0. b2 may be negative.",
    .states = {},
    .params =
        {
            {&SemiPhenomenological::alpha, "alpha", "N", 600.95, 0, 1e6, 0.5, Form::Linear,
             "controllable force"},
            {&SemiPhenomenological::a1, "a1", "s/m", 37.85, 1e-3, 1e6, 10, Form::Constant,
             "steepness over velocity"},
            {&SemiPhenomenological::a2, "a2", "1/m", 22.15, -1e6, 1e6, 0.3, Form::Constant,
             "steepness over position: the width of the loop"},
            {&SemiPhenomenological::b1, "b1", "N*s/m", 2830.86, 0, 1e8, 0.4, Form::Linear,
             "viscous damping"},
            {&SemiPhenomenological::b2, "b2", "N/m", -7897.21, -1e8, 1e8, 0, Form::Linear,
             "stiffness"},
            {&SemiPhenomenological::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant, "offset force",
             Fit::Bias},
        },
    .dissipates =
        "Within the bounds: at every x the force rises with v; what it has at v = 0 is a spring's.",
});

}  // namespace dashpot
