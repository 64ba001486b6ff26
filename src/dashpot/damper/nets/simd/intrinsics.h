#pragma once
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "dashpot/damper/nets/simd/lanes.h"

namespace dashpot {
namespace {

// Operations that the compiler does not make one instruction of by itself. Of AVX-512 the masked
// forms are taken: the unmasked ones make the compiler warn of an uninitialised register.

/// Square root, correctly rounded; the reciprocal's estimate has 11 to 14 bits, or all of them
/// where there is no such instruction.
#if DASHPOT_LANE_BYTES == 64
inline Lanes<double> root(Lanes<double> x) { return _mm512_maskz_sqrt_pd(0xFF, x); }
inline Lanes<float> root(Lanes<float> x) { return _mm512_maskz_sqrt_ps(0xFFFF, x); }
inline Lanes<float> reciprocal_estimate(Lanes<float> x) { return _mm512_maskz_rcp14_ps(0xFFFF, x); }
#elif DASHPOT_LANE_BYTES == 32
inline Lanes<double> root(Lanes<double> x) { return _mm256_sqrt_pd(x); }
inline Lanes<float> root(Lanes<float> x) { return _mm256_sqrt_ps(x); }
inline Lanes<float> reciprocal_estimate(Lanes<float> x) { return _mm256_rcp_ps(x); }
#elif defined(__SSE2__)
inline Lanes<double> root(Lanes<double> x) { return _mm_sqrt_pd(x); }
inline Lanes<float> root(Lanes<float> x) { return _mm_sqrt_ps(x); }
inline Lanes<float> reciprocal_estimate(Lanes<float> x) { return _mm_rcp_ps(x); }
#else
inline Lanes<double> root(Lanes<double> x) {
  for (std::size_t k = 0; k < kLanes<double>; ++k) x[k] = __builtin_sqrt(x[k]);
  return x;
}
inline Lanes<float> root(Lanes<float> x) {
  for (std::size_t k = 0; k < kLanes<float>; ++k) x[k] = __builtin_sqrtf(x[k]);
  return x;
}
inline Lanes<float> reciprocal_estimate(Lanes<float> x) { return 1 / x; }
#endif

/// a > b ? a : b, so b where one of them is a NaN. The compiler would compare and choose.
#if DASHPOT_LANE_BYTES == 64
inline Lanes<double> larger(Lanes<double> a, Lanes<double> b) {
  return _mm512_maskz_max_pd(0xFF, a, b);
}
inline Lanes<float> larger(Lanes<float> a, Lanes<float> b) {
  return _mm512_maskz_max_ps(0xFFFF, a, b);
}
#elif DASHPOT_LANE_BYTES == 32
inline Lanes<double> larger(Lanes<double> a, Lanes<double> b) { return _mm256_max_pd(a, b); }
inline Lanes<float> larger(Lanes<float> a, Lanes<float> b) { return _mm256_max_ps(a, b); }
#elif defined(__SSE2__)
inline Lanes<double> larger(Lanes<double> a, Lanes<double> b) { return _mm_max_pd(a, b); }
inline Lanes<float> larger(Lanes<float> a, Lanes<float> b) { return _mm_max_ps(a, b); }
#else
template <class V>
inline V larger(V a, V b) {
  return a > b ? a : b;
}
#endif

}  // namespace
}  // namespace dashpot
