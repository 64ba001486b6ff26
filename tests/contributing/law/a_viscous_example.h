/* A viscous damper whose force saturates: the example of CONTRIBUTING.md.
 *
 *   F = c v / (1 + |v| / v_1) + f0
 *
 * v m/s (extension positive); F N, same sign as v. No internal state, no hysteresis. Not from the
 * literature.
 */
#ifndef DASHPOT_LAW_A_VISCOUS_EXAMPLE_H
#define DASHPOT_LAW_A_VISCOUS_EXAMPLE_H
#include <math.h>

typedef struct AViscousExample {
  double c;   /* N*s/m, damping at small speed */
  double v_1; /* m/s, speed at which the damping has halved */
  double f0;  /* N, offset */
} AViscousExample;

static inline double a_viscous_example_force(const AViscousExample* p, double x, double v,
                                             const double* z) {
  (void)x, (void)z;
  return p->c * v / (1 + fabs(v) / p->v_1) + p->f0;
}

#endif
