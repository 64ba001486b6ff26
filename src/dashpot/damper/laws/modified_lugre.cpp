#include "dashpot/damper/laws/modified_lugre.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kModifiedLugre;
const Law kModifiedLugre = with_travel<
    ModifiedLugre,
    modified_lugre_travel>(state_law<ModifiedLugre, modified_lugre_force, modified_lugre_derivative,
                                     modified_lugre_rest, modified_lugre_rate>({
    .name = "modified_lugre",
    .title = "Modified LuGre",
    .equation = "z' = v - a_0 |v| z\n"
                "F = sigma_0 z + sigma_1 z' + sigma_2 v + f0",
    .source =
        "Sakai, Ohmori, Sano 2003, IEEE CDC; Jimenez, Alvarez-Icaza 2005, Struct. Control Health "
        "Monit. 12, 45-64; defaults: an example set at 1 V, recalled, not verified",
    .remarks =
        "Linear in the drive when sigma_0 and sigma_2 are, so that its inverse is explicit. The "
        "source writes sigma_a + sigma_0 V for sigma_0 and sigma_2 + sigma_b V for sigma_2. "
        "Dissipates with any parameters. No displacement, so no accumulator spring.",
    .states = {{"z", "m"}},
    .params =
        {
            {&ModifiedLugre::sigma_0, "sigma_0", "N/m", 5.8e4, 0, 1e10, 12, Form::Quadratic,
             "stiffness of the bristles"},
            {&ModifiedLugre::sigma_1, "sigma_1", "N*s/m", 200, 0, 1e8, 0.1, Form::Constant,
             "damping of the bristles"},
            {&ModifiedLugre::sigma_2, "sigma_2", "N*s/m", 2400, 0, 1e8, 0.3, Form::Linear,
             "viscous damping"},
            {&ModifiedLugre::a_0, "a_0", "1/m", 190, 1e-2, 1e6, 20, Form::Constant,
             "steepness of the hysteresis: the bristles slip at z = 1 / a_0"},
            {&ModifiedLugre::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant, "offset force",
             Fit::Bias},
        },
    .needs_displacement = false,
    .dissipates =
        "Within the bounds: sigma_0 z^2 / 2 is stored; sigma_0 a_0 |v| z^2 + sigma_1 v z' + "
        "sigma_2 v^2 is lost, where v z' = v^2 - a_0 |v| v z >= 0 since |z| <= 1 / a_0.",
}));

}  // namespace dashpot
