#include "dashpot/damper/laws/plate_herschel_bulkley.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kPlateHerschelBulkley;
const Law kPlateHerschelBulkley = static_law<PlateHerschelBulkley, plate_herschel_bulkley_force>({
    .name = "plate_herschel_bulkley",
    .title = "Parallel plates, Herschel-Bulkley fluid, valve mode",
    .equation = "F = sgn(v) G + f0,  r = f_y / G\n"
                "(G - f_y) ((1 - r) (1 + n r / (n + 1)))^n = f_v (|v| / v_r)^n",
    .source =
        "Wang, Gordaninejad 1999, J. Intell. Mater. Syst. Struct. 10, 601-608; Wereley 2008, same "
        "journal 19, 257-268; defaults: an example",
    .remarks = "n < 1 is shear thinning, n = 1 is plate_bingham with c0 = f_v / v_r. f_v is meant "
               "at the speed v_r, which a fit sets to the top speed of the data. No hysteresis. "
               "sgn(0) = 0. v_s > 0 makes the force smooth; it is not in the source and not "
               "fitted.",
    .states = {},
    .params =
        {
            {&PlateHerschelBulkley::f_v, "f_v", "N", 300, 0, 1e6, 0.3, Form::Linear,
             "force at speed v_r without yield stress"},
            {&PlateHerschelBulkley::f_y, "f_y", "N", 800, 0, 1e6, 0.4, Form::Quadratic,
             "force below which nothing flows (yield stress)"},
            {&PlateHerschelBulkley::n, "n", "1", 0.8, 0.1, 2, 0.8, Form::Constant,
             "exponent of the shear rate"},
            {&PlateHerschelBulkley::v_r, "v_r", "m/s", 0.25, 1e-6, 100, 1, Form::Constant,
             "speed at which f_v is meant", Fit::Scale},
            {&PlateHerschelBulkley::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant,
             "offset force (accumulator)", Fit::Bias},
            {&PlateHerschelBulkley::v_s, "v_s", "m/s", 0, 0, 1, 0, Form::Constant,
             "speed over which the yield stress sets in; 0: at once", Fit::Fixed},
        },
    .needs_displacement = false,
    .dissipates = "Within the bounds: static, and against v at every speed.",
});

}  // namespace dashpot
