#include "dashpot/damper/laws/landau_surrogate.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kLandauSurrogate;
const Law kLandauSurrogate =
    with_step<LandauSurrogate, landau_surrogate_step>(
        state_law<LandauSurrogate, landau_surrogate_force, landau_surrogate_derivative,
                  landau_surrogate_rest, landau_surrogate_rate>(
            {
                .name = "landau_surrogate",
                .title = "Landau surrogate",
                .equation = "tau p' = v / v_r - (k1 p + k3 p^3 + k5 p^5)\n"
                            "F = f_y p + c v + f0",
                .source = "none: an own example of models after the theory of phase transitions; "
                          "not the model of Wang and Kamath 2006, whose equations were not at hand",
                .remarks =
                    "The scales of p and of time are free to choose, so v_r takes the size of the "
                    "data and k5 keeps its value in a fit. k1 < 0 gives two wells, and a loop even "
                    "at low speed. The loop's width is a time, not a displacement.",
                .states = {{"p", "1"}},
                .params =
                    {
                        {&LandauSurrogate::f_y, "f_y", "N", 800, 0, 1e6, 0.4, Form::Quadratic,
                         "force at p = 1"},
                        {&LandauSurrogate::c, "c", "N*s/m", 1000, 0, 1e8, 0.3, Form::Linear,
                         "viscous damping"},
                        {&LandauSurrogate::tau, "tau", "s", 0.005, 1e-6, 10, 0.03, Form::Constant,
                         "time that p takes"},
                        {&LandauSurrogate::v_r, "v_r", "m/s", 0.02, 1e-6, 10, 0.1, Form::Constant,
                         "speed that drives p with 1", Fit::Scale},
                        {&LandauSurrogate::k1, "k1", "1", -0.2, -10, 1e3, 1, Form::Constant,
                         "slope of the restoring term at p = 0; two wells when negative"},
                        {&LandauSurrogate::k3, "k3", "1", 0, 0, 1e3, 0.3, Form::Constant,
                         "its cubic part"},
                        {&LandauSurrogate::k5, "k5", "1",
                         1.2, 1e-3, 1e3, 1.2, Form::Constant, "its fifth-order part: the scale of p",
                         Fit::Fixed},
                        {&LandauSurrogate::f0, "f0", "N", 0, -1e6, 1e6,
                         0, Form::Constant, "offset force", Fit::Bias},
                    },
                .needs_displacement = false,
                .dissipates = "Where k1 >= 0, beside the bounds: f_y v_r tau p^2 / 2 is stored; c "
                              "v^2 + f_y v_r p^2 (k1 + k3 p^2 + k5 p^4) is lost. With k1 < 0, two "
                              "wells, this says nothing: measured.",
            }));

}  // namespace dashpot
