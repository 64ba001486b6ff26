#pragma once
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "dashpot/damper/neural/simd/lanes.h"

namespace dashpot {
namespace {

#if defined(__AVX512F__)
inline Lanes<double> root(Lanes<double> x) { return _mm512_maskz_sqrt_pd(0xFF, x); }
inline Lanes<float> root_reciprocal_estimate(Lanes<float> x) { return _mm512_maskz_rsqrt14_ps(0xFFFF, x); }
inline Lanes<float> reciprocal_estimate(Lanes<float> x) { return _mm512_maskz_rcp14_ps(0xFFFF, x); }
#elif defined(__AVX2__)
inline Lanes<double> root(Lanes<double> x) { return _mm256_sqrt_pd(x); }
inline Lanes<float> root_reciprocal_estimate(Lanes<float> x) { return _mm256_rsqrt_ps(x); }
inline Lanes<float> reciprocal_estimate(Lanes<float> x) { return _mm256_rcp_ps(x); }
#elif defined(__SSE2__)
inline Lanes<double> root(Lanes<double> x) { return _mm_sqrt_pd(x); }
inline Lanes<float> root_reciprocal_estimate(Lanes<float> x) { return _mm_rsqrt_ps(x); }
inline Lanes<float> reciprocal_estimate(Lanes<float> x) { return _mm_rcp_ps(x); }
#else
inline Lanes<double> root(Lanes<double> x) {
  for (std::size_t k = 0; k < kLanes<double>; ++k) x[k] = __builtin_sqrt(x[k]);
  return x;
}
inline Lanes<float> root_reciprocal_estimate(Lanes<float> x) {
  for (std::size_t k = 0; k < kLanes<float>; ++k) x[k] = 1 / __builtin_sqrtf(x[k]);
  return x;
}
inline Lanes<float> reciprocal_estimate(Lanes<float> x) { return 1 / x; }
#endif

/// value / (sqrt(square) + epsilon)
inline Lanes<double> over_root(Lanes<double> value, Lanes<double> square, double epsilon) {
  return value / (root(square) + epsilon);
}
/// The same within a few units in the last place: each estimate is sharpened by a step of Newton's method,
/// which takes half the time of the processor's square root and division.
inline Lanes<float> over_root(Lanes<float> value, Lanes<float> square, float epsilon) {
  const Lanes<float> smallest = Lanes<float>{} + 1e-37F;  // the estimate of 1 / sqrt(0) is infinite
  const Lanes<float> x = square > smallest ? square : smallest;
  Lanes<float> reciprocal = root_reciprocal_estimate(x);
  reciprocal = reciprocal * (1.5F - 0.5F * x * reciprocal * reciprocal);
  const Lanes<float> divisor = x * reciprocal + epsilon;
  Lanes<float> inverse = reciprocal_estimate(divisor);
  inverse = inverse * (2 - divisor * inverse);
  return value * inverse;
}

}  // namespace
}  // namespace dashpot
