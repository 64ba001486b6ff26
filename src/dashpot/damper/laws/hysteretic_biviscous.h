/* Hysteretic biviscous: the biviscous law with its steep line moved by v0 against the acceleration.
 *
 *   F  = C_pr (v - v0 s) held between C_po v - F_y and C_po v + F_y, + f0
 *   z' = r (v - z),   a = r (v - z),   s = a / sqrt(a^2 + a_s^2)
 *
 * v m/s (extension positive), a m/s^2 its filtered derivative; F N, same sign as v. State: z m/s.
 * At rest z = v. With s = 1 (rising) the knees are at v2 = (F_y + C_pr v0) / (C_pr - C_po) and -v1
 * = -(F_y - C_pr v0) / (C_pr - C_po), as in the source, and mirrored with s = -1. The source asks
 * for C_pr > C_po and C_pr v0 < F_y; written with limits the force is finite and continuous for any
 * values. Source: N. M. Wereley, L. Pang, G. M. Kamath, J. Intell. Mater. Syst. Struct. 9 (1998)
 * 642-649. Differs from it: the smooth s in place of sgn(a), so that at a = 0, thus at rest, the
 * force lies midway between the branches and does not jump; f0.
 */
#ifndef DASHPOT_LAW_HYSTERETIC_BIVISCOUS_H
#define DASHPOT_LAW_HYSTERETIC_BIVISCOUS_H
#include <math.h>

typedef struct HystereticBiviscous {
  double C_po; /* N*s/m, damping after yield */
  double C_pr; /* N*s/m, damping before yield */
  double F_y;  /* N, yield force */
  double v0;   /* m/s, speed at which the force of a branch is zero */
  double a_s;  /* m/s^2, acceleration over which the branches change */
  double r;    /* 1/s, rate of the filter that gives the acceleration */
  double f0;   /* N, offset */
} HystereticBiviscous;

static inline void hysteretic_biviscous_rest(const HystereticBiviscous* p, double x, double v,
                                             double* z) {
  (void)p, (void)x;
  z[0] = v;
}

static inline void hysteretic_biviscous_derivative(const HystereticBiviscous* p, double x, double v,
                                                   const double* z, double* dz) {
  (void)x;
  dz[0] = p->r * (v - z[0]);
}

static inline double hysteretic_biviscous_force(const HystereticBiviscous* p, double x, double v,
                                                const double* z) {
  const double a = p->r * (v - z[0]);
  const double s = a / sqrt(a * a + p->a_s * p->a_s);
  const double after = p->C_po * v;
  (void)x;
  return fmin(fmax(p->C_pr * (v - p->v0 * s), after - p->F_y), after + p->F_y) + p->f0;
}

static inline double hysteretic_biviscous_rate(const HystereticBiviscous* p, double v) {
  (void)v;
  return p->r;
}

#endif
