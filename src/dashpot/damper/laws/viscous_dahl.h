/* Viscous and Dahl: viscous damping beside friction that builds up over a displacement.
 *
 *   w' = rho (v - |v| w),   |w| <= 1
 *   F  = kappa_x v + kappa_w w + f0
 *
 * v m/s (extension positive); F N, same sign as v. State: w, at rest 0.
 * Source: F. Ikhouane, J. Rodellar, Systems with Hysteresis (Wiley 2007). Differs from it: f0.
 */
#ifndef DASHPOT_LAW_VISCOUS_DAHL_H
#define DASHPOT_LAW_VISCOUS_DAHL_H
#include "dahl.h"

typedef struct ViscousDahl {
  double kappa_x; /* N*s/m, viscous damping */
  double kappa_w; /* N, friction force at saturation */
  double rho;     /* 1/m, steepness: 1 / rho is the knee */
  double f0;      /* N, offset */
} ViscousDahl;

static inline void viscous_dahl_rest(const ViscousDahl* p, double x, double v, double* z) {
  (void)p, (void)x, (void)v;
  z[0] = 0;
}

static inline void viscous_dahl_derivative(const ViscousDahl* p, double x, double v,
                                           const double* z, double* dz) {
  (void)x;
  dz[0] = p->rho * (v - fabs(v) * z[0]);
}

static inline double viscous_dahl_force(const ViscousDahl* p, double x, double v, const double* z) {
  (void)x;
  return p->kappa_x * v + p->kappa_w * z[0] + p->f0;
}

/* w after a displacement s of either sign */
static inline double viscous_dahl_travel(const ViscousDahl* p, double w, double s) {
  return dahl_move(p->rho, w, s);
}

/* 1/s: how fast w settles at speed v */
static inline double viscous_dahl_rate(const ViscousDahl* p, double v) { return p->rho * fabs(v); }

#endif
