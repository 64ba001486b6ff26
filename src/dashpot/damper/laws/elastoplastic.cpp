#include "dashpot/damper/laws/elastoplastic.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kElastoplastic;
const Law kElastoplastic = with_step<Elastoplastic, elastoplastic_step>(
    state_law<Elastoplastic, elastoplastic_force, elastoplastic_derivative, elastoplastic_rest,
              elastoplastic_rate>({
        .name = "elastoplastic",
        .title = "Elastoplastic: spring and dry friction in series",
        .equation = "e' = v while k |e| < f_y or e v < 0, else 0\n"
                    "F = k e + c0 v + f0",
        .source = "Iwan 1966, J. Appl. Mech. 33, 893-900, one element; defaults: an example",
        .remarks =
            "The limit of compressible_chambers for a fluid without viscosity, with c0 beside it; "
            "c0 = 0 is the source. A sharp-cornered loop that does not depend on the frequency.",
        .states = {{"e", "m"}},
        .params =
            {
                {&Elastoplastic::c0, "c0", "N*s/m", 1120, 0, 1e8, 0.4, Form::Linear,
                 "viscous damping"},
                {&Elastoplastic::f_y, "f_y", "N", 800, 1e-3, 1e6, 0.5, Form::Quadratic,
                 "friction force (yield stress)"},
                {&Elastoplastic::k, "k", "N/m", 4e5, 0.1, 1e10, 5, Form::Constant,
                 "stiffness of the spring"},
                {&Elastoplastic::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant,
                 "offset force (accumulator)", Fit::Bias},
            },
        .needs_displacement = false,
        .dissipates = "Within the bounds: k e^2 / 2 is stored; the slider and c0 lose.",
    }));

}  // namespace dashpot
