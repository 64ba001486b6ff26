#include "dashpot/damper/laws/field_chain.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kFieldChain;
const Law kFieldChain = static_law<FieldChain, field_chain_force>({
    .name = "field_chain",
    .title = "Multiphysics chain: coil, magnetic circuit, fluid 140CG, flow between plates",
    .equation = "B_c = mu0 turns |i| / (core_length / permeability + gap_length),  B = B_sat B_c / "
                "(B_c + B_sat)\n"
                "H = a1 B + a3 B^3,  tau = b0 + b1 H + b2 H^2 + b3 H^3, held at its maximum\n"
                "F = sgn(v) (G + f_f) + f0\n"
                "G^3 - (c0 |v| + 3/2 Y) G^2 + Y^3 / 2 = 0, largest root,  Y = f_m tau / tau_max",
    .source = "Family paper (Duchanoy et al. 2019), equations 2-11 and table 1, MRF-140CG; flow: "
              "Phillips 1969; defaults: an example, saturation as in the paper's data set",
    .remarks =
        "The circuit-to-fluid chain: how force depends on current follows from it, so that no "
        "parameter does. Fitted are the ampere-turns' scale and the forces; lengths and steel "
        "keep their values, as the data cannot tell them from the turns. The paper's "
        "saturation knee is soft and its yield stress at H = 0 is 4 % of the largest. No "
        "hysteresis; v_s > 0 makes the force smooth and is not fitted.",
    .states = {},
    .params =
        {
            {&FieldChain::c0, "c0", "N*s/m", 1120, 0, 1e8, 0.3, Form::Constant,
             "damping without yield stress"},
            {&FieldChain::f_m, "f_m", "N", 2400, 0, 1e6, 0.7, Form::Constant,
             "force below which nothing flows, at the fluid's largest yield stress"},
            {&FieldChain::f_f, "f_f", "N", 20, 0, 1e6, 0.05, Form::Constant,
             "friction of the seals"},
            {&FieldChain::turns, "turns", "1", 600, 1, 1e6, 600, Form::Constant,
             "turns of the coil"},
            {&FieldChain::current, "current", "A", 1, -100, 100, 0, Form::Linear,
             "current in the coil", Fit::Drive},
            {&FieldChain::core_length, "core_length", "m", 0.1, 1e-4, 10, 0, Form::Constant,
             "length of the magnetic path in steel", Fit::Fixed},
            {&FieldChain::gap_length, "gap_length", "m", 1e-3, 1e-5, 0.1, 0, Form::Constant,
             "length of the magnetic path across the gap", Fit::Fixed},
            {&FieldChain::permeability, "permeability", "1", 2000, 1, 1e6, 0, Form::Constant,
             "relative permeability of the steel", Fit::Fixed},
            {&FieldChain::B_sat, "B_sat", "T", 1.4, 0.1, 5, 0, Form::Constant,
             "flux density that the steel tends to", Fit::Fixed},
            {&FieldChain::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant,
             "offset force (accumulator)", Fit::Bias},
            {&FieldChain::v_s, "v_s", "m/s", 0, 0, 1, 0, Form::Constant,
             "speed over which friction and yield stress set in; 0: at once", Fit::Fixed},
        },
    .needs_displacement = false,
    .dissipates = "Within the bounds: static, and against v at every speed.",
});

}  // namespace dashpot
