/* Dahl: friction whose force builds up over a displacement.
 *
 *   w' = rho (v - |v| w),   |w| <= 1
 *   F  = kappa_w w + f0
 *
 * v m/s (extension positive); F N, same sign as v. State: w, at rest 0.
 * Independent of speed: a damper needs viscous_dahl. Source: P. R. Dahl, AIAA Journal 14 (1976)
 * 1675-1682, in the normalised notation of F. Ikhouane, J. Rodellar, Systems with Hysteresis (Wiley
 * 2007). Differs from them: f0.
 */
#ifndef DASHPOT_LAW_DAHL_H
#define DASHPOT_LAW_DAHL_H
#include <math.h>

typedef struct Dahl {
  double kappa_w; /* N, friction force at saturation */
  double rho;     /* 1/m, steepness: 1 / rho is the knee */
  double f0;      /* N, offset */
} Dahl;

static inline void dahl_rest(const Dahl* p, double x, double v, double* z) {
  (void)p, (void)x, (void)v;
  z[0] = 0;
}

static inline void dahl_derivative(const Dahl* p, double x, double v, const double* z, double* dz) {
  (void)x;
  dz[0] = p->rho * (v - fabs(v) * z[0]);
}

static inline double dahl_force(const Dahl* p, double x, double v, const double* z) {
  (void)x, (void)v;
  return p->kappa_w * z[0] + p->f0;
}

/* w after a displacement s of either sign */
static inline double dahl_move(double rho, double w, double s) {
  return w + (w - (s < 0 ? -1 : 1)) * expm1(-rho * fabs(s));
}

static inline double dahl_travel(const Dahl* p, double w, double s) {
  return dahl_move(p->rho, w, s);
}

/* 1/s: how fast w settles at speed v */
static inline double dahl_rate(const Dahl* p, double v) { return p->rho * fabs(v); }

#endif
