/* Polynomial with hysteresis: one polynomial of velocity for rising, one for falling speed.
 *
 *   F  = f0 + d0 s + (m1 + d1 s) u + (m2 + d2 s) u^2 + ... + (m6 + d6 s) u^6,   u = v / v_max
 *   z' = r (v - z),   a = r (v - z),   s = a / sqrt(a^2 + a_s^2)
 *
 * v m/s (extension positive), a m/s^2 its filtered derivative; F N, same sign as v. State: z m/s.
 * At rest z = v. u is held within -1 ... 1: beyond the data a polynomial of order 6 explodes.
 * Source: S. B. Choi, S. K. Lee, Y. P. Park, J. Sound Vib. 245 (2001) 375-383, which writes F = sum
 * a_k v^k with a set a_k for a > 0 and another for a < 0: a_k = (m_k + d_k) / v_max^k and (m_k -
 * d_k) / v_max^k, with m_0 = f0, the mean of both a_0. A damper that pulls as it pushes has m2, m4,
 * m6, d1, d3, d5 and f0 zero. Differs from the source: the limit of u, and the smooth s in place of
 * sgn(a), so that at a = 0, thus at rest, the force lies midway between the branches and does not
 * jump.
 */
#ifndef DASHPOT_LAW_POLYNOMIAL_H
#define DASHPOT_LAW_POLYNOMIAL_H
#include <math.h>

typedef struct Polynomial {
  double f0;    /* N, offset: the mean of both branches at v = 0 */
  double m1;    /* N, mean of both branches, times u */
  double m2;    /* N, mean of both branches, times u^2 */
  double m3;    /* N, mean of both branches, times u^3 */
  double m4;    /* N, mean of both branches, times u^4 */
  double m5;    /* N, mean of both branches, times u^5 */
  double m6;    /* N, mean of both branches, times u^6 */
  double d0;    /* N, half the difference of rising and falling branch at v = 0 */
  double d1;    /* N, half their difference, times u */
  double d2;    /* N, half their difference, times u^2 */
  double d3;    /* N, half their difference, times u^3 */
  double d4;    /* N, half their difference, times u^4 */
  double d5;    /* N, half their difference, times u^5 */
  double d6;    /* N, half their difference, times u^6 */
  double v_max; /* m/s, where the polynomials end */
  double a_s;   /* m/s^2, acceleration over which the branches change */
  double r;     /* 1/s, rate of the filter that gives the acceleration */
} Polynomial;

static inline void polynomial_rest(const Polynomial* p, double x, double v, double* z) {
  (void)p, (void)x;
  z[0] = v;
}

static inline void polynomial_derivative(const Polynomial* p, double x, double v, const double* z,
                                         double* dz) {
  (void)x;
  dz[0] = p->r * (v - z[0]);
}

static inline double polynomial_force(const Polynomial* p, double x, double v, const double* z) {
  const double a = p->r * (v - z[0]);
  const double s = a / sqrt(a * a + p->a_s * p->a_s);
  const double u = fmin(fmax(v / p->v_max, -1), 1);
  const double mean =
      u * (p->m1 + u * (p->m2 + u * (p->m3 + u * (p->m4 + u * (p->m5 + u * p->m6)))));
  const double half =
      p->d0 + u * (p->d1 + u * (p->d2 + u * (p->d3 + u * (p->d4 + u * (p->d5 + u * p->d6)))));
  (void)x;
  return p->f0 + mean + s * half;
}

static inline double polynomial_rate(const Polynomial* p, double v) {
  (void)v;
  return p->r;
}

#endif
