#include "dashpot/damper/laws/polynomial.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kPolynomial;
const Law kPolynomial =
    state_law<Polynomial, polynomial_force, polynomial_derivative, polynomial_rest,
              polynomial_rate>({
        .name = "polynomial",
        .title = "Polynomial with hysteresis (Choi)",
        .equation =
            "F = f0 + d0 s + (m1 + d1 s) u + ... + (m6 + d6 s) u^6, u = v / v_max within -1 ... 1\n"
            "z' = r (v - z), a = r (v - z), s = a / sqrt(a^2 + a_s^2)",
        .source =
            "Choi, Lee, Park 2001, J. Sound Vib. 245, 375-383, form recalled; defaults: an example "
            "of our own at 1 A",
        .remarks =
            "s is sgn(a) made smooth: midway between the branches at rest, and with a_s as large "
            "as fits find it, a loop that widens with the acceleration as measured ones do. The "
            "source's coefficients are a_k = (m_k + d_k) / v_max^k for rising speed and (m_k - "
            "d_k) / v_max^k for falling; f0 is the mean of both a_0. Held beyond v_max. One set of "
            "coefficients serves for all speeds, so it is poor where slow and fast motions mix.",
        .states = {{"v_f", "m/s"}},
        .params =
            {
                {&Polynomial::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant,
                 "offset force: the mean of both branches at v = 0", Fit::Bias},
                {&Polynomial::m1, "m1", "N", 3729.6, -1e8, 1e8, 0.8, Form::Linear,
                 "mean of both branches, times u"},
                {&Polynomial::m2, "m2", "N", 0, -1e8, 1e8, 0, Form::Linear,
                 "mean of both branches, times u^2", Fit::Fixed},
                {&Polynomial::m3, "m3", "N", -4806.5, -1e8, 1e8, 0, Form::Linear,
                 "mean of both branches, times u^3"},
                {&Polynomial::m4, "m4", "N", 0, -1e8, 1e8, 0, Form::Linear,
                 "mean of both branches, times u^4", Fit::Fixed},
                {&Polynomial::m5, "m5", "N", 2712.5, -1e8, 1e8, 0, Form::Linear,
                 "mean of both branches, times u^5"},
                {&Polynomial::m6, "m6", "N", 0, -1e8, 1e8, 0, Form::Linear,
                 "mean of both branches, times u^6", Fit::Fixed},
                {&Polynomial::d0, "d0", "N", -247.6, -1e8, 1e8, -0.1, Form::Linear,
                 "half the difference of rising and falling branch"},
                {&Polynomial::d1, "d1", "N", 0, -1e8, 1e8, 0, Form::Linear,
                 "half the difference of rising and falling branch, times u", Fit::Fixed},
                {&Polynomial::d2, "d2", "N", 1462.7, -1e8, 1e8, 0, Form::Linear,
                 "half the difference of rising and falling branch, times u^2"},
                {&Polynomial::d3, "d3", "N", 0, -1e8, 1e8, 0, Form::Linear,
                 "half the difference of rising and falling branch, times u^3", Fit::Fixed},
                {&Polynomial::d4, "d4", "N", -2654.8, -1e8, 1e8, 0, Form::Linear,
                 "half the difference of rising and falling branch, times u^4"},
                {&Polynomial::d5, "d5", "N", 0, -1e8, 1e8, 0, Form::Linear,
                 "half the difference of rising and falling branch, times u^5", Fit::Fixed},
                {&Polynomial::d6, "d6", "N", 1477.4, -1e8, 1e8, 0, Form::Linear,
                 "half the difference of rising and falling branch, times u^6"},
                {&Polynomial::v_max, "v_max", "m/s", 0.3, 1e-6, 100, 1, Form::Constant,
                 "speed at which the polynomials end", Fit::Scale},
                {&Polynomial::a_s, "a_s", "m/s^2", 0.05, 1e-6, 1e3, 1, Form::Constant,
                 "acceleration over which the branches change"},
                {&Polynomial::r, "r", "1/s", 200, 1, 1e4, 200, Form::Constant,
                 "rate of the filter that gives the acceleration", Fit::Fixed},
            },
        .needs_displacement = false,
    });

}  // namespace dashpot
