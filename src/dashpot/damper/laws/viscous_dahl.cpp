#include "dashpot/damper/laws/viscous_dahl.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kViscousDahl;
const Law kViscousDahl = with_travel<
    ViscousDahl,
    viscous_dahl_travel>(state_law<ViscousDahl, viscous_dahl_force, viscous_dahl_derivative,
                                   viscous_dahl_rest, viscous_dahl_rate>({
    .name = "viscous_dahl",
    .title = "Viscous and Dahl",
    .equation = "w' = rho (v - |v| w)\n"
                "F = kappa_x v + kappa_w w + f0",
    .source =
        "Ikhouane, Rodellar 2007, Systems with Hysteresis, Wiley; defaults: the small damper of "
        "the utfpr recordings without voltage, as in the code beside them",
    .remarks = "The fewest parameters with a loop, each of which can be identified: the normalised "
               "Bouc-Wen law with sigma = 1, n = 1. No displacement, so no accumulator spring.",
    .states = {{"w", "1"}},
    .params =
        {
            {&ViscousDahl::kappa_x, "kappa_x", "N*s/m", 768.2, 0, 1e8, 0.3, Form::Linear,
             "viscous damping"},
            {&ViscousDahl::kappa_w, "kappa_w", "N", 57.42, 0, 1e6, 0.6, Form::Quadratic,
             "friction force at saturation"},
            {&ViscousDahl::rho, "rho", "1/m", 27450, 1e-2, 1e6, 20, Form::Constant,
             "steepness of the hysteresis: 1 / rho is its knee"},
            {&ViscousDahl::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant, "offset force",
             Fit::Bias},
        },
    .needs_displacement = false,
    .dissipates = "Within the bounds: kappa_w w^2 / (2 rho) is stored, and kappa_x v^2 + kappa_w "
                  "|v| w^2 is lost.",
}));

}  // namespace dashpot
