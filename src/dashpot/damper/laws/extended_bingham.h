/* Extended Bingham (viscoelastic-plastic): a Bingham element, a standard solid and a spring in
 * series.
 *
 *   g   = k2 (x - x2)
 *   x1' = 0 where |g| <= f_c, else (g - f_c sgn g) / c0
 *   x2' = x1' + (g - k1 (x2 - x1)) / c1
 *   F   = g + f0
 *
 * x m (extension positive); F N, same sign as the velocity. States: x1 m, x2 m; at rest x1 = x2 =
 * x. The yield force is compared with g, not with F. Source: D. R. Gamota, F. E. Filisko, J.
 * Rheology 35 (1991) 399-425, in the form of B. F. Spencer, S. J. Dyke, M. K. Sain, J. D. Carlson,
 * J. Eng. Mech. 123 (1997) 230-238. Differs from it: nothing; solved for the states.
 */
#ifndef DASHPOT_LAW_EXTENDED_BINGHAM_H
#define DASHPOT_LAW_EXTENDED_BINGHAM_H
#include <math.h>

typedef struct ExtendedBingham {
  double c0;  /* N*s/m, damping after yield */
  double f_c; /* N, yield force */
  double c1;  /* N*s/m, damping of the solid */
  double k1;  /* N/m, stiffness of the solid */
  double k2;  /* N/m, stiffness of the spring */
  double f0;  /* N, offset */
} ExtendedBingham;

static inline void extended_bingham_rest(const ExtendedBingham* p, double x, double v, double* z) {
  (void)p, (void)v;
  z[0] = x;
  z[1] = x;
}

/* x1' under the force g */
static inline double extended_bingham_flow(const ExtendedBingham* p, double g) {
  return copysign(fmax(fabs(g) - p->f_c, 0), g) / p->c0;
}

static inline void extended_bingham_derivative(const ExtendedBingham* p, double x, double v,
                                               const double* z, double* dz) {
  const double g = p->k2 * (x - z[1]);
  (void)v;
  dz[0] = extended_bingham_flow(p, g);
  dz[1] = dz[0] + (g - p->k1 * (z[1] - z[0])) / p->c1;
}

static inline double extended_bingham_force(const ExtendedBingham* p, double x, double v,
                                            const double* z) {
  (void)v;
  return p->k2 * (x - z[1]) + p->f0;
}

/* Slopes dz at the end of an implicit Euler step of length h from z to the displacement x. Every
 * element resists its own motion, so that the force g has one value: it yields or it does not. */
static inline void extended_bingham_implicit(const ExtendedBingham* p, double x, double h,
                                             const double* z, double* dz) {
  const double ease = 1 / (p->c1 + h * p->k1), stretch = z[1] - z[0];
  /* g / k2 + h (g - k1 stretch) ease + h flow(g) = x - x2 */
  const double reach = x - z[1] + h * p->k1 * stretch * ease, give = 1 / p->k2 + h * ease;
  double g = reach / give;
  if (fabs(g) > p->f_c) g = (reach + copysign(h * p->f_c / p->c0, g)) / (give + h / p->c0);
  dz[0] = extended_bingham_flow(p, g);
  dz[1] = dz[0] + (g - p->k1 * stretch) * ease;
}

/* States after a step of length h in which x goes linearly from x[0] to x[1]: the two-stage
 * diagonally implicit Runge-Kutta method of second order, which damps what is stiff at any length.
 */
static inline int extended_bingham_step(const ExtendedBingham* p, const double* x, const double* v,
                                        double h, double* z) {
  const double share = 1 - 0.70710678118654752; /* 1 - 1/sqrt(2) */
  double first[2], second[2], start[2];
  int k;
  (void)v;
  extended_bingham_implicit(p, x[0] + share * (x[1] - x[0]), share * h, z, first);
  for (k = 0; k < 2; ++k) start[k] = z[k] + (1 - share) * h * first[k];
  extended_bingham_implicit(p, x[1], share * h, start, second);
  for (k = 0; k < 2; ++k) z[k] = start[k] + share * h * second[k];
  return 1;
}

/* 1/s: bound of the rate at which the springs relax */
static inline double extended_bingham_rate(const ExtendedBingham* p, double v) {
  (void)v;
  return p->k2 / p->c0 + (p->k1 + p->k2) / p->c1;
}

#endif
