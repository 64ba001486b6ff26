/* A spring in series with dry friction, beside a dashpot.
 *
 *   e' = v while k |e| < f_y or e v < 0, else 0;   F = k e + c0 v + f0
 *
 * v m/s (extension positive); F N, same sign as v. State: e m, stretch of the spring. At rest e =
 * 0. The limit of compressible_chambers for a fluid without viscosity (c0 = 0); c0 stands for what
 * the limit loses. Beyond its yield stretch, where a numerical step or a falling f_y may leave it,
 * e goes back within a stroke of a quarter of that stretch; the force does not feel it. Source: W.
 * D. Iwan, J. Appl. Mech. 33 (1966) 893-900, with one element. Differs from it: c0 and f0.
 */
#ifndef DASHPOT_LAW_ELASTOPLASTIC_H
#define DASHPOT_LAW_ELASTOPLASTIC_H
#include "../../physics/plate_flow.h"

typedef struct Elastoplastic {
  double c0;  /* N*s/m, viscous damping */
  double f_y; /* N, friction force */
  double k;   /* N/m, stiffness of the spring */
  double f0;  /* N, offset: accumulator */
} Elastoplastic;

/* m, the stretch at which friction gives way; positive also where an f_y that falls with current
 * has crossed
 * 0 */
static inline double elastoplastic_limit(const Elastoplastic* p) {
  return fmax(p->f_y, 1e-6) / p->k;
}

static inline void elastoplastic_rest(const Elastoplastic* p, double x, double v, double* z) {
  (void)p, (void)x, (void)v;
  z[0] = 0;
}

static inline void elastoplastic_derivative(const Elastoplastic* p, double x, double v,
                                            const double* z, double* dz) {
  const double limit = elastoplastic_limit(p), beyond = fabs(z[0]) - limit;
  (void)x;
  dz[0] = beyond >= 0 && z[0] * v > 0 ? 0 : v;
  if (beyond > 0) dz[0] -= plate_side(z[0]) * 4 * fabs(v) * beyond / limit;
}

static inline double elastoplastic_force(const Elastoplastic* p, double x, double v,
                                         const double* z) {
  const double limit = elastoplastic_limit(p);
  (void)x;
  return p->k * fmin(fmax(z[0], -limit), limit) + p->c0 * v + p->f0;
}

/* State after a step of length h in which v goes linearly from v[0] to v[1]: exact, turn by turn */
static inline int elastoplastic_step(const Elastoplastic* p, const double* x, const double* v,
                                     double h, double* z) {
  const double limit = elastoplastic_limit(p);
  const double turn = v[0] * v[1] < 0 ? h * v[0] / (v[0] - v[1]) : h;
  const double turned = turn < h ? 0 : v[1];
  (void)x;
  z[0] = fmin(fmax(z[0] + 0.5 * turn * (v[0] + turned), -limit), limit);
  if (turn < h) z[0] = fmin(fmax(z[0] + 0.5 * (h - turn) * v[1], -limit), limit);
  return 1;
}

/* 1/s: bound of the rate at which e goes back to its limit */
static inline double elastoplastic_rate(const Elastoplastic* p, double v) {
  return 4 * fabs(v) / elastoplastic_limit(p);
}

#endif
