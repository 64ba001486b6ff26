#include "contributing/law/a_viscous_example.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kAViscousExample;
const Law kAViscousExample = static_law<AViscousExample, a_viscous_example_force>({
    .name = "a_viscous_example",
    .title = "Saturating viscous damper",
    .equation = "F = c v / (1 + |v| / v_1) + f0",
    .source = "made up for CONTRIBUTING.md",
    .remarks = "No hysteresis.",
    .states = {},
    .params =
        {
            {&AViscousExample::c, "c", "N*s/m", 5000, 0, 1e8, 1, Form::Linear,
             "damping at small speed"},
            {&AViscousExample::v_1, "v_1", "m/s", 0.2, 1e-3, 1e3, 1, Form::Constant,
             "speed at which the damping has halved"},
            {&AViscousExample::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant, "offset force",
             Fit::Bias},
        },
    .needs_displacement = false,
});

}  // namespace dashpot
