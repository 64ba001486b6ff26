/* Landau surrogate: an order parameter that follows the velocity late, as in a theory of phase
 * transitions.
 *
 *   tau p' = v / v_r - (k1 p + k3 p^3 + k5 p^5)
 *   F      = f_y p + c v + f0
 *
 * v m/s (extension positive); F N, same sign as v. State: p, at rest 0.
 * k1 > 0: a smooth lag; k1 < 0: two wells, between which p jumps. Source: none, an own example of
 * the kind. It is not the model of Wang and Kamath (2006), whose equations were not at hand.
 */
#ifndef DASHPOT_LAW_LANDAU_SURROGATE_H
#define DASHPOT_LAW_LANDAU_SURROGATE_H
#include <math.h>

typedef struct LandauSurrogate {
  double f_y; /* N, force at p = 1 */
  double c;   /* N*s/m, viscous damping */
  double tau; /* s, time that p takes */
  double v_r; /* m/s, speed that drives p with 1 */
  double k1;  /* 1, slope of the restoring term at p = 0 */
  double k3;  /* 1, its cubic part */
  double k5;  /* 1, its fifth-order part */
  double f0;  /* N, offset */
} LandauSurrogate;

static inline void landau_surrogate_rest(const LandauSurrogate* p, double x, double v, double* z) {
  (void)p, (void)x, (void)v;
  z[0] = 0;
}

static inline void landau_surrogate_derivative(const LandauSurrogate* p, double x, double v,
                                               const double* z, double* dz) {
  const double q = z[0] * z[0];
  (void)x;
  dz[0] = (v / p->v_r - z[0] * (p->k1 + q * (p->k3 + q * p->k5))) / p->tau;
}

static inline double landau_surrogate_force(const LandauSurrogate* p, double x, double v,
                                            const double* z) {
  (void)x;
  return p->f_y * z[0] + p->c * v + p->f0;
}

/* The order parameter q with q + g (k1 q + k3 q^3 + k5 q^5) = drive, by Newton's method from
 * `guess`. The left side grows, and bends away from 0, so that no step overshoots but the first. */
static inline double landau_surrogate_implicit(const LandauSurrogate* p, double g, double drive,
                                               double guess) {
  double q = guess;
  int k;
  for (k = 0; k < 60; ++k) {
    const double s = q * q;
    const double excess = q * (1 + g * (p->k1 + s * (p->k3 + s * p->k5))) - drive;
    const double change = excess / (1 + g * (p->k1 + s * (3 * p->k3 + s * 5 * p->k5)));
    const double tolerance = 1e-10; /* single precision: 1e-5 */
    q -= change;
    if (fabs(change) <= tolerance * (1 + fabs(q))) break;
  }
  return q;
}

/* p after a step of length h in which v goes linearly from v[0] to v[1], by the two-stage
 * diagonally implicit Runge-Kutta method of second order, which damps what is stiff at any length;
 * returns 0, with p untouched, where the step is too long for the time in which the wells part. */
static inline int landau_surrogate_step(const LandauSurrogate* p, const double* x, const double* v,
                                        double h, double* z) {
  const double share = 1 - 0.70710678118654752; /* 1 - 1/sqrt(2) */
  const double g = share * h / p->tau;
  double drive, slope, start;
  (void)x;
  if (1 + g * p->k1 < 0.5) return 0;
  drive = z[0] + g * (v[0] + share * (v[1] - v[0])) / p->v_r;
  slope = (landau_surrogate_implicit(p, g, drive, z[0]) - z[0]) / (share * h);
  start = z[0] + (1 - share) * h * slope;
  drive = start + g * v[1] / p->v_r;
  z[0] = landau_surrogate_implicit(p, g, drive, start);
  return 1;
}

/* 1/s: bound of the rate at which p settles at speed v */
static inline double landau_surrogate_rate(const LandauSurrogate* p, double v) {
  const double wells = p->k1 < 0 ? -p->k1 / p->k5 : 0;
  const double q = sqrt(2 * wells) + pow(2 * fabs(v) / (p->v_r * p->k5), 0.4); /* p^2 at most */
  return (fabs(p->k1) + q * (3 * p->k3 + q * 5 * p->k5)) / p->tau;
}

#endif
