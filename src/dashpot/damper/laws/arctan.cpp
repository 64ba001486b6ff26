#include "dashpot/damper/laws/arctan.h"

#include "dashpot/damper/law.h"

namespace dashpot {
namespace {

double fastest_arctan(const Arctan& p) { return p.a_s / p.v_h; }

}  // namespace

extern const Law kArctan;
const Law kArctan =
    with_fastest_rate<Arctan, fastest_arctan>(
        state_law<Arctan, arctan_force, arctan_derivative, arctan_rest, arctan_rate>({
            .name = "arctan",
            .title = "Inverse tangent",
            .equation = "F = (2 / pi) f_y atan(kappa (v - v_h s)) + c v + f0\n"
                        "z' = r (v - z), a = r (v - z), s = a / sqrt(a^2 + a_s^2)",
            .source =
                "after Cesmeci, Engin 2010, Int. J. Mech. Sci. 52, 1036-1046, in a form of our "
                "own; defaults: an example of our own",
            .remarks =
                "s is sgn(a) made smooth: midway between the branches at rest, and with a_s as "
                "large as fits find it, a loop that widens with the acceleration as measured ones "
                "do. Approaches its yield force slower than tanh does.",
            .states = {{"v_f", "m/s"}},
            .params =
                {
                    {&Arctan::f_y, "f_y", "N", 600, 0, 1e6, 0.6, Form::Quadratic, "yield force"},
                    {&Arctan::kappa, "kappa", "s/m", 80, 1e-3, 1e6, 12, Form::Constant,
                     "steepness"},
                    {&Arctan::v_h, "v_h", "m/s", 0.01, 0, 1, 0.03, Form::Constant,
                     "half width of the loop"},
                    {&Arctan::c, "c", "N*s/m", 1000, 0, 1e8, 0.3, Form::Linear, "viscous damping"},
                    {&Arctan::a_s, "a_s", "m/s^2", 0.05, 1e-6, 1e3, 1, Form::Constant,
                     "acceleration over which the branches change"},
                    {&Arctan::r, "r", "1/s", 200, 1, 1e4, 200, Form::Constant,
                     "rate of the filter that gives the acceleration", Fit::Fixed},
                    {&Arctan::f0, "f0", "N", 20, -1e6, 1e6, 0, Form::Constant, "offset force",
                     Fit::Bias},
                },
            .needs_displacement = false,
            .dissipates =
                "Where r v_h <= a_s, beside the bounds (f_y, c >= 0). With y = v - z, z' = r y, "
                "the rising odd function phi has the argument w = z + psi(y). While psi(y) lies "
                "between 0 and y, phi(w) v >= phi(z) y = (phi(z) / r) z', the rate of a stored "
                "energy: case by case of the signs of z, y and w. Here psi(y) = y - v_h s, and s "
                "is steepest, 1 / a_s, at a = 0. Beyond, quick and small motions meet the damping "
                "(2 / pi) f_y kappa (1 - r v_h / a_s) + c.",
        }));

}  // namespace dashpot
