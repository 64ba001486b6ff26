/* Hyperbolic tangent of velocity and position, of Guo: hysteresis without internal state.
 *
 *   F = A1 tanh(A3 w) + A2 w + f0,   w = v + (V0 / X0) x
 *
 * x m, v m/s (extension positive); F N, same sign as v. V0, X0: critical velocity and displacement
 * of the hysteresis; only their ratio matters. V0 > 0 turns the loop the right way round. Assumes a
 * motion centred on x = 0: subtract the mean stroke. Source: S. Guo, S. Yang, C. Pan, J. Intell.
 * Mater. Syst. Struct. 17 (2006) 3-14. Differs from it: f0.
 */
#ifndef DASHPOT_LAW_TANH_GUO_H
#define DASHPOT_LAW_TANH_GUO_H
#include <math.h>

typedef struct TanhGuo {
  double A1; /* N, yield force */
  double A2; /* N*s/m, damping after yield */
  double A3; /* s/m, slope before yield */
  double V0; /* m/s, critical velocity of the hysteresis */
  double X0; /* m, critical displacement of the hysteresis */
  double f0; /* N, offset */
} TanhGuo;

static inline double tanh_guo_force(const TanhGuo* p, double x, double v, const double* z) {
  const double w = v + p->V0 / p->X0 * x;
  (void)z;
  return p->A1 * tanh(p->A3 * w) + p->A2 * w + p->f0;
}

#endif
