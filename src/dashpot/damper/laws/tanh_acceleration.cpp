#include "dashpot/damper/laws/tanh_acceleration.h"

#include "dashpot/damper/law.h"

namespace dashpot {
namespace {

double fastest_tanh_acceleration(const TanhAcceleration& p) { return 1 / p.tau; }

}  // namespace

extern const Law kTanhAcceleration;
const Law kTanhAcceleration = with_fastest_rate<
    TanhAcceleration,
    fastest_tanh_acceleration>(state_law<TanhAcceleration, tanh_acceleration_force,
                                         tanh_acceleration_derivative, tanh_acceleration_rest,
                                         tanh_acceleration_rate>({
    .name = "tanh_acceleration",
    .title = "Hyperbolic tangent of velocity and acceleration",
    .equation = "F = f_y tanh(kappa (v - tau a)) + c v + f0\n"
                "z' = r (v - z), a = r (v - z)",
    .source =
        "our own smooth variant of the sigmoid law (Ma, Wang, Rakheja, Su 2002); defaults: our fit "
        "of public recordings of a 1.6 kN damper at 1 A",
    .remarks =
        "The width of the loop grows with the acceleration, as measured ones do: the best of the "
        "algebraic laws on sines of several frequencies.",
    .states = {{"v_f", "m/s"}},
    .params =
        {
            {&TanhAcceleration::f_y, "f_y", "N", 1034.51, 0, 1e6, 0.6, Form::Quadratic,
             "yield force"},
            {&TanhAcceleration::kappa, "kappa", "s/m", 99.3466, 1e-3, 1e6, 10, Form::Constant,
             "steepness"},
            {&TanhAcceleration::tau, "tau", "s", 7.65641e-3, 0, 1, 0.03, Form::Constant,
             "delay of the force behind velocity"},
            {&TanhAcceleration::c, "c", "N*s/m", 6256.33, 0, 1e8, 0.4, Form::Linear,
             "viscous damping"},
            {&TanhAcceleration::r, "r", "1/s", 200, 1, 1e4, 200, Form::Constant,
             "rate of the filter that gives the acceleration", Fit::Fixed},
            {&TanhAcceleration::f0, "f0", "N", 1.446, -1e6, 1e6, 0, Form::Constant, "offset force",
             Fit::Bias},
        },
    .needs_displacement = false,
    .dissipates = "Where r tau <= 1, beside the bounds (f_y, c >= 0). With y = v - z, z' = r y, "
                  "the rising odd function phi has the argument w = z + psi(y). While psi(y) lies "
                  "between 0 and y, phi(w) v >= phi(z) y = (phi(z) / r) z', the rate of a stored "
                  "energy: case by case of the signs of z, y and w. Here psi(y) = (1 - r tau) y. "
                  "Beyond, quick and small motions meet the damping f_y kappa (1 - r tau) + c.",
}));

}  // namespace dashpot
