/* Sigmoid: a saturating force that grows with speed, moved by v_h against the acceleration.
 *
 *   F  = f_m tanh(k_a (v - v_h s) / 2) (1 + k_v |v|) + f0
 *   z' = r (v - z),   a = r (v - z),   s = a / sqrt(a^2 + a_s^2)
 *
 * v m/s (extension positive), a m/s^2 its filtered derivative; F N, same sign as v. State: z m/s.
 * At rest z = v. tanh(w / 2) is the source's (1 - e^-w) / (1 + e^-w) without its overflow. Source:
 * X. Q. Ma, E. R. Wang, S. Rakheja, C.-Y. Su, Proc. 41st IEEE Conf. Decision and Control (2002);
 * the symmetric core of it, with constant v_h. Differs from it: f0, and the smooth s in place of
 * sgn(a), so that at a = 0, thus at rest, the force lies midway between the branches and does not
 * jump.
 */
#ifndef DASHPOT_LAW_SIGMOID_H
#define DASHPOT_LAW_SIGMOID_H
#include <math.h>

typedef struct Sigmoid {
  double f_m; /* N, force at saturation */
  double k_a; /* s/m, steepness */
  double k_v; /* s/m, growth after saturation */
  double v_h; /* m/s, half width of the loop */
  double a_s; /* m/s^2, acceleration over which the branches change */
  double r;   /* 1/s, rate of the filter that gives the acceleration */
  double f0;  /* N, offset */
} Sigmoid;

static inline void sigmoid_rest(const Sigmoid* p, double x, double v, double* z) {
  (void)p, (void)x;
  z[0] = v;
}

static inline void sigmoid_derivative(const Sigmoid* p, double x, double v, const double* z,
                                      double* dz) {
  (void)x;
  dz[0] = p->r * (v - z[0]);
}

static inline double sigmoid_force(const Sigmoid* p, double x, double v, const double* z) {
  const double a = p->r * (v - z[0]);
  const double s = a / sqrt(a * a + p->a_s * p->a_s);
  (void)x;
  return p->f_m * tanh(0.5 * p->k_a * (v - p->v_h * s)) * (1 + p->k_v * fabs(v)) + p->f0;
}

static inline double sigmoid_rate(const Sigmoid* p, double v) {
  (void)v;
  return p->r;
}

#endif
