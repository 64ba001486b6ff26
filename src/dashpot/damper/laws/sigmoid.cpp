#include "dashpot/damper/laws/sigmoid.h"

#include "dashpot/damper/law.h"

namespace dashpot {
namespace {

double fastest_sigmoid(const Sigmoid& p) { return p.a_s / (p.v_h * (1 + p.k_v * p.v_h)); }

}  // namespace

extern const Law kSigmoid;
const Law kSigmoid =
    with_fastest_rate<Sigmoid, fastest_sigmoid>(
        state_law<Sigmoid, sigmoid_force, sigmoid_derivative, sigmoid_rest, sigmoid_rate>({
            .name = "sigmoid",
            .title = "Sigmoid",
            .equation = "F = f_m tanh(k_a (v - v_h s) / 2) (1 + k_v |v|) + f0\n"
                        "z' = r (v - z), a = r (v - z), s = a / sqrt(a^2 + a_s^2)",
            .source = "Ma, Wang, Rakheja, Su 2002, Proc. 41st IEEE Conf. Decision and Control, its "
                      "symmetric core, form recalled; defaults: an example of our own",
            .remarks =
                "s is sgn(a) made smooth: midway between the branches at rest, and with a_s as "
                "large as fits find it, a loop that widens with the acceleration as measured ones "
                "do. k_v makes damping after yield proportional to the yield force.",
            .states = {{"v_f", "m/s"}},
            .params =
                {
                    {&Sigmoid::f_m, "f_m", "N", 900, 0, 1e6, 0.6, Form::Quadratic,
                     "force at saturation"},
                    {&Sigmoid::k_a, "k_a", "s/m", 120, 1e-3, 1e6, 20, Form::Constant, "steepness"},
                    {&Sigmoid::k_v, "k_v", "s/m", 1.5, 0, 1e4, 0.5, Form::Constant,
                     "growth after saturation"},
                    {&Sigmoid::v_h, "v_h", "m/s", 0.008, 0, 1, 0.03, Form::Constant,
                     "half width of the loop"},
                    {&Sigmoid::a_s, "a_s", "m/s^2", 0.05, 1e-6, 1e3, 1, Form::Constant,
                     "acceleration over which the branches change"},
                    {&Sigmoid::r, "r", "1/s", 200, 1, 1e4, 200, Form::Constant,
                     "rate of the filter that gives the acceleration", Fit::Fixed},
                    {&Sigmoid::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant, "offset force",
                     Fit::Bias},
                },
            .needs_displacement = false,
            .dissipates =
                "Where r v_h (1 + k_v v_h) <= a_s, beside the bounds (f_m, k_v >= 0). With y = v - "
                "z, z' = r y, the rising odd function phi has the argument w = z + psi(y). While "
                "psi(y) lies between 0 and y, phi(w) v >= phi(z) y = (phi(z) / r) z', the rate of "
                "a stored energy: case by case of the signs of z, y and w. Here psi(y) = y - v_h "
                "s. Where v and w differ in sign, |v| <= v_h |s| <= |y| r v_h / a_s, so that the "
                "factor 1 + k_v |v| <= 1 + k_v v_h leaves phi(w) v (1 + k_v |v|) >= phi(z) y.",
        }));

}  // namespace dashpot
