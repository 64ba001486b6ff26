#include "dashpot/damper/laws/plate_bingham_shear.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kPlateBinghamShear;
const Law kPlateBinghamShear = static_law<PlateBinghamShear, plate_bingham_shear_force>({
    .name = "plate_bingham_shear",
    .title = "Parallel plates, Bingham-Papanastasiou fluid, shear mode",
    .equation = "F = c0 v + f_y sgn(v) (1 - exp(-|v| / v_s)) + f0",
    .source = "Wereley, Pang 1998, Smart Mater. Struct. 7, 732-743; onset: Papanastasiou 1987, J. "
              "Rheol. 31, 385-404; defaults: an example",
    .remarks = "c0 = eta w L / h, f_y = tau w L, v_s = h / m with Papanastasiou's time m. With v_s "
               "= 0 it is Bingham's law. No hysteresis.",
    .states = {},
    .params =
        {
            {&PlateBinghamShear::c0, "c0", "N*s/m", 1120, 0, 1e8, 0.4, Form::Linear,
             "viscous damping"},
            {&PlateBinghamShear::f_y, "f_y", "N", 800, 0, 1e6, 0.5, Form::Quadratic,
             "force of the yield stress"},
            {&PlateBinghamShear::v_s, "v_s", "m/s", 0.01, 0, 10, 0.05, Form::Constant,
             "speed over which the yield stress sets in; 0: at once"},
            {&PlateBinghamShear::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant,
             "offset force (accumulator)", Fit::Bias},
        },
    .needs_displacement = false,
    .dissipates = "Within the bounds: static, and against v at every speed.",
});

}  // namespace dashpot
