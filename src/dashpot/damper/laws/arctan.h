/* Inverse tangent: an arctangent over velocity, moved by v_h against the acceleration.
 *
 *   F  = (2 / pi) f_y atan(kappa (v - v_h s)) + c v + f0
 *   z' = r (v - z),   a = r (v - z),   s = a / sqrt(a^2 + a_s^2)
 *
 * v m/s (extension positive), a m/s^2 its filtered derivative; F N, same sign as v. State: z m/s.
 * At rest z = v. After the algebraic model of S. Cesmeci, T. Engin, Int. J. Mech. Sci. 52 (2010)
 * 1036-1046, whose exact form was not at hand: this form is our own. s is a smooth sgn(a): at a =
 * 0, thus at rest, the force lies midway between the branches and does not jump.
 */
#ifndef DASHPOT_LAW_ARCTAN_H
#define DASHPOT_LAW_ARCTAN_H
#include <math.h>

typedef struct Arctan {
  double f_y;   /* N, yield force */
  double kappa; /* s/m, steepness */
  double v_h;   /* m/s, half width of the loop */
  double c;     /* N*s/m, viscous damping */
  double a_s;   /* m/s^2, acceleration over which the branches change */
  double r;     /* 1/s, rate of the filter that gives the acceleration */
  double f0;    /* N, offset */
} Arctan;

static inline void arctan_rest(const Arctan* p, double x, double v, double* z) {
  (void)p, (void)x;
  z[0] = v;
}

static inline void arctan_derivative(const Arctan* p, double x, double v, const double* z,
                                     double* dz) {
  (void)x;
  dz[0] = p->r * (v - z[0]);
}

static inline double arctan_force(const Arctan* p, double x, double v, const double* z) {
  const double a = p->r * (v - z[0]);
  const double s = a / sqrt(a * a + p->a_s * p->a_s);
  const double two_over_pi = 0.63661977236758134;
  (void)x;
  return two_over_pi * p->f_y * atan(p->kappa * (v - p->v_h * s)) + p->c * v + p->f0;
}

static inline double arctan_rate(const Arctan* p, double v) {
  (void)v;
  return p->r;
}

#endif
