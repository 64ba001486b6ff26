/* Modified clipped-optimal: the share of the current range, where (f_c - f) f > 0 in proportion to
 * |f_c|, full from force_max on. */
#include "inverse_share.h"

static inline double modified_clipped_optimal_share(const InverseInput* input, double force_max) {
  return (missing_force(input) > 0) ? (fabs(input->wanted) / force_max) : 0;
}
