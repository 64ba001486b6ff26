#include "dashpot/damper/laws/compressible_chambers.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kCompressibleChambers;
const Law kCompressibleChambers = with_step<CompressibleChambers, compressible_chambers_step>(
    state_law<CompressibleChambers, compressible_chambers_force, compressible_chambers_derivative,
              compressible_chambers_rest, compressible_chambers_rate>({
        .name = "compressible_chambers",
        .title = "Dynamic fluid model: compressible chambers, Bingham fluid in the gap",
        .equation = "e' = v - sgn(e) N(k |e|) / c0\n"
                    "N(G) = G (1 - f_y / G)^2 (1 + f_y / (2 G)) for G > f_y, else 0\n"
                    "F = k e + f_f sgn(v) + f0",
        .source = "Flow balance of two chambers, after J. Intell. Mater. Syst. Struct. 2014, "
                  "10.1177/1045389X13500576 (abstract only); gap: Phillips 1969; defaults: 0.5 GPa "
                  "in two chambers of 100 cm^3, else the example of plate_bingham",
        .remarks = "The first-principles model with hysteresis: the fluid's compression is a "
                   "spring in series with the gap. k = 2 beta A^2 / V holds the bulk modulus with "
                   "the air in the fluid. Equal and constant chambers; e is the stroke that "
                   "compression has taken up. Its limit without viscosity is elastoplastic.",
        .states = {{"e", "m"}},
        .params =
            {
                {&CompressibleChambers::c0, "c0", "N*s/m", 1120, 0.1, 1e8, 0.3, Form::Linear,
                 "damping without yield stress"},
                {&CompressibleChambers::f_y, "f_y", "N", 800, 0, 1e6, 0.4, Form::Quadratic,
                 "force below which nothing flows (yield stress)"},
                {&CompressibleChambers::k, "k", "N/m", 2.5e6, 0.1, 1e10, 10, Form::Constant,
                 "stiffness of the fluid in both chambers"},
                {&CompressibleChambers::f_f, "f_f", "N", 20, 0, 1e6, 0.05, Form::Constant,
                 "friction of the seals"},
                {&CompressibleChambers::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant,
                 "offset force (accumulator)", Fit::Bias},
            },
        .needs_displacement = false,
        .dissipates = "Within the bounds: k e^2 / 2 is stored; the flow through the valve, which "
                      "follows k e with its sign, and the friction f_f lose.",
    }));

}  // namespace dashpot
