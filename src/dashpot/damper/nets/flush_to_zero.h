#pragma once
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace dashpot {

/// While one lives, this thread's denormal numbers are zero: the moments of neurons that died decay
/// into denormals, which cost ten times the time. What was set before comes back in the end.
class FlushToZero {
 public:
#if defined(__SSE__)
  FlushToZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }  // FTZ and DAZ
  ~FlushToZero() { _mm_setcsr(before_); }
#else
  FlushToZero() = default;
#endif
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
#if defined(__SSE__)
  unsigned before_;
#endif
};

}  // namespace dashpot
