/* Signum, continuous state: the share of the current range, G (f_c - f) sgn f; full at an error of
 * a tenth of the largest force. */
#include "inverse_share.h"

static inline double signum_share(const InverseInput* input, double force_max) {
  return 10 * missing_force(input) / force_max;
}
