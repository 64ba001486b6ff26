#include "dashpot/damper/laws/hysteretic_biviscous.h"

#include <algorithm>

#include "dashpot/damper/law.h"

namespace dashpot {
namespace {

double fastest_hysteretic_biviscous(const HystereticBiviscous& p) {
  return std::max(0.0, p.C_pr - p.C_po) * p.a_s / (p.C_pr * p.v0);
}

}  // namespace

extern const Law kHystereticBiviscous;
const Law kHystereticBiviscous =
    with_fastest_rate<HystereticBiviscous, fastest_hysteretic_biviscous>(
        state_law<HystereticBiviscous, hysteretic_biviscous_force, hysteretic_biviscous_derivative,
                  hysteretic_biviscous_rest, hysteretic_biviscous_rate>({
            .name = "hysteretic_biviscous",
            .title = "Hysteretic biviscous",
            .equation = "F = C_pr (v - v0 s) held between C_po v - F_y and C_po v + F_y, + f0\n"
                        "z' = r (v - z), a = r (v - z), s = a / sqrt(a^2 + a_s^2)",
            .source =
                "Wereley, Pang, Kamath 1998, J. Intell. Mater. Syst. Struct. 9, 642-649, form "
                "recalled; defaults: an example of our own",
            .remarks =
                "s is the source's sgn(a) made smooth: midway between the branches at rest, and "
                "with a_s as large as fits find it, a loop that widens with the acceleration as "
                "measured ones do. C_pr > C_po and C_pr v0 < F_y are meant, not needed: the "
                "force is finite and continuous without them.",
            .states = {{"v_f", "m/s"}},
            .params =
                {
                    {&HystereticBiviscous::C_po, "C_po", "N*s/m", 2000, 0, 1e8, 0.4, Form::Linear,
                     "damping after yield"},
                    {&HystereticBiviscous::C_pr, "C_pr", "N*s/m", 50000, 0, 1e10, 8, Form::Linear,
                     "damping before yield"},
                    {&HystereticBiviscous::F_y, "F_y", "N", 800, 0, 1e6, 0.5, Form::Quadratic,
                     "yield force"},
                    {&HystereticBiviscous::v0, "v0", "m/s", 0.005, 0, 1, 0.03, Form::Constant,
                     "speed at which the force of a branch is zero"},
                    {&HystereticBiviscous::a_s, "a_s", "m/s^2", 0.05, 1e-6, 1e3, 1, Form::Constant,
                     "acceleration over which the branches change"},
                    {&HystereticBiviscous::r, "r", "1/s", 200, 1, 1e4, 200, Form::Constant,
                     "rate of the filter that gives the acceleration", Fit::Fixed},
                    {&HystereticBiviscous::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant,
                     "offset force", Fit::Bias},
                },
            .needs_displacement = false,
            .dissipates =
                "Where C_pr > C_po and r C_pr v0 <= (C_pr - C_po) a_s, beside the bounds. F = C_po "
                "v + phi(w), phi limited to +-F_y with the slope C_pr - C_po. With y = v - z, z' = "
                "r y, the rising odd function phi has the argument w = z + psi(y). While psi(y) "
                "lies between 0 and y, phi(w) v >= phi(z) y = (phi(z) / r) z', the rate of a "
                "stored energy: case by case of the signs of z, y and w. Here psi(y) = y - s v0 "
                "C_pr / (C_pr - C_po).",
        }));

}  // namespace dashpot
