#include "dashpot/damper/laws/normalised_bouc_wen.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kNormalisedBoucWen;
const Law kNormalisedBoucWen = with_travel<NormalisedBoucWen, normalised_bouc_wen_travel>(
    state_law<NormalisedBoucWen, normalised_bouc_wen_force, normalised_bouc_wen_derivative,
              normalised_bouc_wen_rest, normalised_bouc_wen_rate>({
        .name = "normalised_bouc_wen",
        .title = "Normalised Bouc-Wen",
        .equation = "w' = rho (v - sigma |v| |w|^(n-1) w + (sigma - 1) v |w|^n)\n"
                    "F = kappa_x v + kappa_w w + f0",
        .source =
            "Ikhouane, Rodellar 2007, Systems with Hysteresis, Wiley; defaults: an example of the "
            "1 kN class",
        .remarks = "|w| <= 1 whatever the parameters, and each of them can be identified: the "
                   "scale of z that the other Bouc-Wen laws leave open is gone. sigma = gamma / "
                   "(gamma + beta): below 1/2 the loop would create energy when small, above 1 "
                   "beta is negative. No displacement, so no accumulator spring.",
        .states = {{"w", "1"}},
        .params =
            {
                {&NormalisedBoucWen::kappa_x, "kappa_x", "N*s/m", 800, 0, 1e8, 0.3, Form::Linear,
                 "viscous damping"},
                {&NormalisedBoucWen::kappa_w, "kappa_w", "N", 150, 0, 1e6, 0.6, Form::Quadratic,
                 "hysteresis force at saturation"},
                {&NormalisedBoucWen::rho, "rho", "1/m", 1000, 1e-2, 1e6, 20, Form::Constant,
                 "steepness of the hysteresis: 1 / rho is its knee"},
                {&NormalisedBoucWen::sigma, "sigma", "1", 0.75, 0.5, 1e3, 0.75, Form::Constant,
                 "how much steeper w leaves a saturation than zero"},
                {&NormalisedBoucWen::n, "n", "1", 2, 1, 20, 1.5, Form::Constant,
                 "sharpness of the knee"},
                {&NormalisedBoucWen::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant, "offset force",
                 Fit::Bias},
            },
        .needs_displacement = false,
        .dissipates = "With kappa_x, kappa_w >= 0, rho > 0 and sigma >= 1/2, as bounded (Ikhouane "
                      "and Rodellar): as bouc_wen, whose gamma is then no less than beta.",
    }));

}  // namespace dashpot
