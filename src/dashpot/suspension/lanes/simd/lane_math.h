#pragma once
#include "dashpot/damper/nets/simd/activations.h"

// The functions of math.h that a law's text calls, for lanes. Where a function is not worth vector
// code, the library's own is called for each lane.
namespace dashpot {
namespace {

using Lane = Lanes<double>;
using LaneMask = LaneTypes<double>::Integers;
constexpr std::size_t kWidth = kLanes<double>;

inline Lane all(double value) { return Lane{} + value; }

inline bool any(LaneMask mask) {
#if DASHPOT_LANE_BYTES == 64
  return _mm512_movepi64_mask(__builtin_bit_cast(__m512i, mask)) != 0;
#elif DASHPOT_LANE_BYTES == 32
  return _mm256_movemask_pd(__builtin_bit_cast(__m256d, mask)) != 0;
#elif defined(__SSE2__)
  return _mm_movemask_pd(__builtin_bit_cast(__m128d, mask)) != 0;
#else
  bool found = false;
  for (std::size_t k = 0; k < kWidth; ++k) found = found || mask[k] != 0;
  return found;
#endif
}

/// a < b ? a : b, so b where one of them is a NaN.
#if DASHPOT_LANE_BYTES == 64
inline Lane smaller(Lane a, Lane b) { return _mm512_maskz_min_pd(0xFF, a, b); }
inline Lanes<float> smaller(Lanes<float> a, Lanes<float> b) {
  return _mm512_maskz_min_ps(0xFFFF, a, b);
}
#elif DASHPOT_LANE_BYTES == 32
inline Lane smaller(Lane a, Lane b) { return _mm256_min_pd(a, b); }
inline Lanes<float> smaller(Lanes<float> a, Lanes<float> b) { return _mm256_min_ps(a, b); }
#elif defined(__SSE2__)
inline Lane smaller(Lane a, Lane b) { return _mm_min_pd(a, b); }
inline Lanes<float> smaller(Lanes<float> a, Lanes<float> b) { return _mm_min_ps(a, b); }
#else
template <class V>
inline V smaller(V a, V b) {
  return a < b ? a : b;
}
#endif
inline Lane fmax(Lane a, Lane b) { return larger(a, b); }
inline Lane fmax(Lane a, double b) { return larger(a, all(b)); }
inline Lane fmax(double a, Lane b) { return larger(all(a), b); }
inline Lane fmin(Lane a, Lane b) { return smaller(a, b); }
inline Lane fmin(Lane a, double b) { return fmin(a, all(b)); }
inline Lane fmin(double a, Lane b) { return fmin(all(a), b); }
inline Lane fabs(Lane x) {
  return __builtin_bit_cast(Lane, __builtin_bit_cast(LaneMask, x) & INT64_MAX);
}
inline Lane sqrt(Lane x) { return root(x); }
inline Lane tanh(Lane x) { return tanh_lanes<double>(x); }

template <class Function>
inline Lane each(Lane x, Function function) {
  for (std::size_t k = 0; k < kWidth; ++k) x[k] = function(x[k]);
  return x;
}
inline Lane exp(Lane x) {
  return each(x, [](double value) { return __builtin_exp(value); });
}
inline Lane atan(Lane x) {
  return each(x, [](double value) { return __builtin_atan(value); });
}
/// Most powers are the first or the second.
inline Lane pow(Lane base, Lane power) {
  const LaneMask other = (power != 1) & (power != 2);
  const Lane quick = power == 2 ? base * base : base;
  if (!any(other)) return quick;
  for (std::size_t k = 0; k < kWidth; ++k)
    base[k] = other[k] ? __builtin_pow(base[k], power[k]) : quick[k];
  return base;
}

/// 2^r for |r| <= 1/2: the polynomial that meets it at the zeros of Chebyshev's (of degree 8; 6 for
/// floats). Even and odd powers are summed apart, since what counts is how long one call takes.
inline Lane power_of_two(Lane r) {
  const Lane square = r * r;
  const Lane even =
      (((1.325964524488711e-06 * square + 0.0001540343375125101) * square + 0.009618129193934313) *
           square +
       0.2402265069564034) *
          square +
      1;

  const Lane odd = (((1.0205905413765595e-07 * square + 1.5252672924850737e-05) * square +
                     0.0013333558200794592) *
                        square +
                    0.05550410866465167) *
                       square +
                   0.6931471805599462;
  return odd * r + even;
}
inline Lanes<float> power_of_two(Lanes<float> r) {
  const Lanes<float> square = r * r;
  const Lanes<float> even =
      ((0.0001545316294F * square + 0.009618082557F) * square + 0.2402265076F) * square + 1;
  return ((0.001339086336F * square + 0.05550357114F) * square + 0.693147188F) * r + even;
}

/// exp(2x) for |x| <= kFarthest, relative error at most 3e-14 + 2e-16 |x|, of floats their last
/// digits; beyond, that of kFarthest.
template <class Real, int kFarthest = static_cast<int>(Arithmetic<Real>::kTanhOne)>
[[gnu::always_inline]] inline Lanes<Real> exp_of_twice(Lanes<Real> x) {
  using A = Arithmetic<Real>;
  using V = Lanes<Real>;
  constexpr Real kTwoLog2E = static_cast<Real>(2.88539008177792681472),
                 kRound = A::kRound + A::kBias;
  constexpr Real kMost = kFarthest;
  const V y = larger(V{} - kMost, smaller(V{} + kMost, x));  // a NaN passes
  const V shifted = y * kTwoLog2E + kRound;
  const auto bits = __builtin_bit_cast(typename LaneTypes<Real>::Integers, shifted) << A::kMantissa;
  return power_of_two(y * kTwoLog2E - (shifted - kRound)) * __builtin_bit_cast(V, bits);
}

/// x^(-1/5) within a tenth, for x > 0: a double's bits, read as an integer, are nearly linear in
/// log2 x. Good enough for the length of a step.
inline Lane about_fifth_root_below(Lane x) {
  constexpr double kOne = 1023;
  const Lane log2 = __builtin_convertvector(__builtin_bit_cast(LaneMask, x), Lane) * 0x1p-52 - kOne;
  return __builtin_bit_cast(Lane, __builtin_convertvector((log2 * -0.2 + kOne) * 0x1p52, LaneMask));
}

}  // namespace
}  // namespace dashpot
