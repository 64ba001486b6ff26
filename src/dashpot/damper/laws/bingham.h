/* Bingham: viscous damping and dry friction.
 *
 *   F = c0 v + f_c s(v) + f0,   s(v) = sgn(v), with sgn(0) = 0;   tanh(v / v_s) when v_s > 0
 *
 * v m/s (extension positive); F N, same sign as v. No internal state, no hysteresis.
 * v_s = 0 is the published law. A small v_s > 0 makes the friction smooth for a solver that cannot
 * step over a jump; |F| then falls short of it by less than 0.5 % of f_c beyond |v| = 3 v_s.
 * Source: R. Stanway, J. L. Sproston, N. G. Stevens, J. Electrostatics 20 (1987) 167-184; with the
 * offset f0 as in B. F. Spencer et al., J. Eng. Mech. 123 (1997) 230-238. Differs from them: v_s.
 */
#ifndef DASHPOT_LAW_BINGHAM_H
#define DASHPOT_LAW_BINGHAM_H
#include <math.h>

typedef struct Bingham {
  double c0;  /* N*s/m, viscous damping */
  double f_c; /* N, friction force: the fluid's yield stress */
  double f0;  /* N, offset: accumulator */
  double v_s; /* m/s, speed over which friction sets in; 0: at once */
} Bingham;

static inline double bingham_force(const Bingham* p, double x, double v, const double* z) {
  const double s = p->v_s > 0 ? tanh(v / p->v_s) : v > 0 ? 1.0 : v < 0 ? -1.0 : 0.0;
  (void)x, (void)z;
  return p->c0 * v + p->f_c * s + p->f0;
}

#endif
