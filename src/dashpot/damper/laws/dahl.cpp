#include "dashpot/damper/laws/dahl.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kDahl;
const Law kDahl = with_travel<Dahl, dahl_travel>(state_law<Dahl, dahl_force, dahl_derivative,
                                                           dahl_rest, dahl_rate>({
    .name = "dahl",
    .title = "Dahl",
    .equation = "w' = rho (v - |v| w)\n"
                "F = kappa_w w + f0",
    .source = "Dahl 1976, AIAA Journal 14, 1675-1682, normalised as in Ikhouane, Rodellar 2007; "
              "defaults: an example of the 1 kN class",
    .remarks =
        "Friction with a knee in displacement; the force does not know the speed. Two parameters: "
        "a yardstick for viscous_dahl and the Bouc-Wen laws.",
    .states = {{"w", "1"}},
    .params =
        {
            {&Dahl::kappa_w, "kappa_w", "N", 150, 0, 1e6, 0.8, Form::Quadratic,
             "friction force at saturation"},
            {&Dahl::rho, "rho", "1/m", 2000, 1e-2, 1e6, 20, Form::Constant,
             "steepness of the hysteresis: 1 / rho is its knee"},
            {&Dahl::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant, "offset force", Fit::Bias},
        },
    .needs_displacement = false,
    .dissipates =
        "Within the bounds: kappa_w w^2 / (2 rho) is stored, and kappa_w |v| w^2 is lost.",
}));

}  // namespace dashpot
