/* Biviscous: a stiff dashpot before the fluid yields, a soft one after.
 *
 *   F = C_pr v                within |v| <= v_y,   v_y = F_y / (C_pr - C_po)
 *   F = C_po v + F_y sgn(v)   beyond;              + f0 everywhere
 *
 * v m/s (extension positive); F N, same sign as v. No internal state, no hysteresis.
 * Written as C_pr v held between C_po v - F_y and C_po v + F_y, which is the same where C_pr >
 * C_po, and stays finite, continuous and dissipative where a fit strays from that. Source: R.
 * Stanway, J. L. Sproston, A. K. El-Wahed, Smart Mater. Struct. 5 (1996) 464-482. Differs from it:
 * f0.
 */
#ifndef DASHPOT_LAW_BIVISCOUS_H
#define DASHPOT_LAW_BIVISCOUS_H
#include <math.h>

typedef struct Biviscous {
  double C_po; /* N*s/m, damping after yield */
  double C_pr; /* N*s/m, damping before yield */
  double F_y;  /* N, yield force */
  double f0;   /* N, offset */
} Biviscous;

static inline double biviscous_force(const Biviscous* p, double x, double v, const double* z) {
  const double after = p->C_po * v;
  (void)x, (void)z;
  return fmin(fmax(p->C_pr * v, after - p->F_y), after + p->F_y) + p->f0;
}

#endif
