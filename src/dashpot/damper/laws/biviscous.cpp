#include "dashpot/damper/laws/biviscous.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kBiviscous;
const Law kBiviscous = static_law<Biviscous, biviscous_force>({
    .name = "biviscous",
    .title = "Biviscous",
    .equation = "F = C_pr v held between C_po v - F_y and C_po v + F_y, + f0",
    .source = "Stanway, Sproston, El-Wahed 1996, Smart Mater. Struct. 5, 464-482, form recalled; "
              "defaults: an example of our own",
    .remarks =
        "Bingham with a steep line in place of the jump; no hysteresis. The knee is at v_y = F_y / "
        "(C_pr - C_po). C_pr > C_po is meant, not needed: the force is finite, continuous and "
        "dissipative without it.",
    .states = {},
    .params =
        {
            {&Biviscous::C_po, "C_po", "N*s/m", 2000, 0, 1e8, 0.4, Form::Linear,
             "damping after yield"},
            {&Biviscous::C_pr, "C_pr", "N*s/m", 50000, 0, 1e10, 8, Form::Linear,
             "damping before yield"},
            {&Biviscous::F_y, "F_y", "N", 800, 0, 1e6, 0.5, Form::Quadratic, "yield force"},
            {&Biviscous::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant, "offset force", Fit::Bias},
        },
    .needs_displacement = false,
    .dissipates =
        "Within the bounds: static, and against v at every speed, whether C_pr > C_po or not.",
});

}  // namespace dashpot
