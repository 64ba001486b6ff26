/* Heaviside step on the wanted dissipation: the share of the current range, full where f_c v > 0.
 */
#include "inverse_share.h"

static inline double heaviside_share(const InverseInput* input, double force_max) {
  (void)force_max;
  return ((sign_of(input->wanted) * sign_of(input->velocity)) > 0) ? 1 : 0;
}
