#include "dashpot/damper/laws/chebyshev.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kChebyshev;
const Law kChebyshev = static_law<Chebyshev, chebyshev_force>({
    .name = "chebyshev",
    .title = "Restoring-force surface (Chebyshev)",
    .equation = "F = sum of c_ij T_i(x') T_j(v'), i = 0 ... 2, j = 0 ... 5, c_00 = f0\n"
                "x' = (x - x_mid) / x_half, v' = v / v_half, both within -1 ... 1",
    .source = "Masri, Caughey 1979, J. Appl. Mech. 46, 433-447; Gavin 2001; forms recalled; "
              "defaults: an example of our own",
    .remarks =
        "No assumption on the shape. Held at the edge of the data. By default a fit finds the "
        "terms T_j(v') with odd j and x' T_j(v') with even j. The others keep their value unless "
        "asked for: those with i + j even are zero for a damper that pulls as it pushes, and "
        "with T_2(x') the surface goes astray between motions that it has not seen. Sines of one "
        "frequency fill an ellipse, not the square: then terms cannot be told apart.",
    .states = {},
    .params =
        {
            {&Chebyshev::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant,
             "offset force: factor of T_0 T_0", Fit::Bias},
            {&Chebyshev::c01, "c01", "N", 900, -1e6, 1e6, 0.8, Form::Linear,
             "factor of T_0(x') T_1(v')"},
            {&Chebyshev::c02, "c02", "N", 0, -1e6, 1e6, 0, Form::Linear,
             "factor of T_0(x') T_2(v')", Fit::Fixed},
            {&Chebyshev::c03, "c03", "N", -150, -1e6, 1e6, -0.2, Form::Linear,
             "factor of T_0(x') T_3(v')"},
            {&Chebyshev::c04, "c04", "N", 0, -1e6, 1e6, 0, Form::Linear,
             "factor of T_0(x') T_4(v')", Fit::Fixed},
            {&Chebyshev::c05, "c05", "N", 50, -1e6, 1e6, 0.1, Form::Linear,
             "factor of T_0(x') T_5(v')"},
            {&Chebyshev::c10, "c10", "N", 100, -1e6, 1e6, 0.1, Form::Linear,
             "factor of T_1(x') T_0(v')"},
            {&Chebyshev::c11, "c11", "N", 0, -1e6, 1e6, 0, Form::Linear,
             "factor of T_1(x') T_1(v')", Fit::Fixed},
            {&Chebyshev::c12, "c12", "N", -80, -1e6, 1e6, -0.1, Form::Linear,
             "factor of T_1(x') T_2(v')"},
            {&Chebyshev::c13, "c13", "N", 0, -1e6, 1e6, 0, Form::Linear,
             "factor of T_1(x') T_3(v')", Fit::Fixed},
            {&Chebyshev::c14, "c14", "N", 20, -1e6, 1e6, 0, Form::Linear,
             "factor of T_1(x') T_4(v')"},
            {&Chebyshev::c15, "c15", "N", 0, -1e6, 1e6, 0, Form::Linear,
             "factor of T_1(x') T_5(v')", Fit::Fixed},
            {&Chebyshev::c20, "c20", "N", 0, -1e6, 1e6, 0, Form::Linear,
             "factor of T_2(x') T_0(v')", Fit::Fixed},
            {&Chebyshev::c21, "c21", "N", 0, -1e6, 1e6, 0, Form::Linear,
             "factor of T_2(x') T_1(v')", Fit::Fixed},
            {&Chebyshev::c22, "c22", "N", 0, -1e6, 1e6, 0, Form::Linear,
             "factor of T_2(x') T_2(v')", Fit::Fixed},
            {&Chebyshev::c23, "c23", "N", 0, -1e6, 1e6, 0, Form::Linear,
             "factor of T_2(x') T_3(v')", Fit::Fixed},
            {&Chebyshev::c24, "c24", "N", 0, -1e6, 1e6, 0, Form::Linear,
             "factor of T_2(x') T_4(v')", Fit::Fixed},
            {&Chebyshev::c25, "c25", "N", 0, -1e6, 1e6, 0, Form::Linear,
             "factor of T_2(x') T_5(v')", Fit::Fixed},
            {&Chebyshev::x_mid, "x_mid", "m", 0, -10, 10, 0, Form::Constant, "middle of the stroke",
             Fit::Scale},
            {&Chebyshev::x_half, "x_half", "m", 0.03, 1e-6, 10, 1, Form::Constant,
             "half of the stroke", Fit::Scale},
            {&Chebyshev::v_half, "v_half", "m/s", 0.2, 1e-6, 100, 1, Form::Constant,
             "half of the span of velocity", Fit::Scale},
        },
    .dissipates = "Where F(x, v1) >= F(x, -v2) at every x for all v1, v2 > 0: then and only then "
                  "no closed path takes energy from a static law. An inequality of polynomials "
                  "without a closed set of coefficients: measured.",
});

}  // namespace dashpot
