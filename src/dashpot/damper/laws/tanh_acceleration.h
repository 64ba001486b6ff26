/* Hyperbolic tangent of velocity less acceleration: a loop whose width grows with the acceleration.
 *
 *   F  = f_y tanh(kappa (v - tau a)) + c v + f0
 *   z' = r (v - z),   a = r (v - z)
 *
 * v m/s (extension positive), a m/s^2 its filtered derivative; F N, same sign as v. State: z m/s.
 * At rest z = v, a = 0 and nothing jumps. v - tau a is v delayed by about tau. Source: our own
 * smooth variant of the sigmoid law (Ma, Wang, Rakheja, Su 2002), whose width of the loop grows
 * with the acceleration's amplitude.
 */
#ifndef DASHPOT_LAW_TANH_ACCELERATION_H
#define DASHPOT_LAW_TANH_ACCELERATION_H
#include <math.h>

typedef struct TanhAcceleration {
  double f_y;   /* N, yield force */
  double kappa; /* s/m, steepness */
  double tau;   /* s, delay of the force behind velocity */
  double c;     /* N*s/m, viscous damping */
  double r;     /* 1/s, rate of the filter that gives the acceleration */
  double f0;    /* N, offset */
} TanhAcceleration;

static inline void tanh_acceleration_rest(const TanhAcceleration* p, double x, double v,
                                          double* z) {
  (void)p, (void)x;
  z[0] = v;
}

static inline void tanh_acceleration_derivative(const TanhAcceleration* p, double x, double v,
                                                const double* z, double* dz) {
  (void)x;
  dz[0] = p->r * (v - z[0]);
}

static inline double tanh_acceleration_force(const TanhAcceleration* p, double x, double v,
                                             const double* z) {
  const double a = p->r * (v - z[0]);
  (void)x;
  return p->f_y * tanh(p->kappa * (v - p->tau * a)) + p->c * v + p->f0;
}

static inline double tanh_acceleration_rate(const TanhAcceleration* p, double v) {
  (void)v;
  return p->r;
}

#endif
