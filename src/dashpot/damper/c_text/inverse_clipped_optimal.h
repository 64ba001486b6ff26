/* Clipped-optimal: the share of the current range, full where (f_c - f) f > 0. */
#include "inverse_share.h"

static inline double clipped_optimal_share(const InverseInput* input, double force_max) {
  (void)force_max;
  return (missing_force(input) > 0) ? 1 : 0;
}
