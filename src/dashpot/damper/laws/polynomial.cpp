#include "dashpot/damper/laws/polynomial.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/law.h"

namespace dashpot {
namespace {

/// That with which a force against v appears nowhere as long as the acceleration is no more than
/// r |v|, which is all that a quick motion about v = 0 has: |s| half < mean at each u.
double fastest_polynomial(const Polynomial& p) {
  constexpr int kSpeeds = 16;
  double fastest = INFINITY;
  for (int k = -kSpeeds; k <= kSpeeds; ++k) {
    if (k == 0) continue;

    // The branches at this speed: their mean, counted along v, and half their difference.
    const double u = static_cast<double>(k) / kSpeeds;
    const double mean =
        std::abs(u) * (p.m1 + u * (p.m2 + u * (p.m3 + u * (p.m4 + u * (p.m5 + u * p.m6)))));
    const double half =
        p.d0 + u * (p.d1 + u * (p.d2 + u * (p.d3 + u * (p.d4 + u * (p.d5 + u * p.d6)))));

    // Where the rising branch lies below the mean by more than the mean, s must stay short of 1.
    if (half >= -std::max(mean, 0.0)) continue;
    const double share = std::max(mean, 0.0) / -half;
    const double acceleration = p.a_s * share / std::sqrt(1 - share * share);
    fastest = std::min(fastest, acceleration / (std::abs(u) * p.v_max));
  }
  return fastest;
}

}  // namespace

extern const Law kPolynomial;
const Law kPolynomial = with_fastest_rate<Polynomial, fastest_polynomial>(
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
        .dissipates = "No closed set is known. Needed, with m the mean of both branches counted "
                      "along v and h half their difference: m > 0 at every u, and in quick motions "
                      "about v = 0, where a = r v, m + s h >= 0 up to v_max, thus r |v| <= a_s m / "
                      "sqrt(h^2 - m^2) wherever h < -m. A fit keeps r below the least of these "
                      "and, while the measured verdict fails, below halves of it.",
    }));

}  // namespace dashpot
