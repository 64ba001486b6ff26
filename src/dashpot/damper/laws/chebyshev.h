/* Restoring-force surface: the force as a sum of products of Chebyshev polynomials of position and
 * velocity.
 *
 *   F = sum over i = 0 ... 2, j = 0 ... 5 of c_ij T_i(x') T_j(v'),   c_00 = f0
 *   x' = (x - x_mid) / x_half,   v' = v / v_half,   both held within -1 ... 1
 *   T_0 = 1,   T_1(s) = s,   T_k+1 = 2 s T_k - T_k-1
 *
 * x m, v m/s (extension positive); F N, same sign as v. No internal state: hysteresis shows as far
 * as position tells the branches apart. Outside the data a polynomial explodes, so x' and v' are
 * held at their edge. The terms with i + j odd are those of a damper that pulls as it pushes.
 * Source: S. F. Masri, T. K. Caughey, J. Appl. Mech. 46 (1979) 433-447; used for these dampers by
 * H. P. Gavin (2001). Differs from them: the edge.
 */
#ifndef DASHPOT_LAW_CHEBYSHEV_H
#define DASHPOT_LAW_CHEBYSHEV_H
#include <math.h>

typedef struct Chebyshev {
  double f0, c01, c02, c03, c04, c05;  /* N, factors of T_0(x') T_j(v'); f0 is the offset */
  double c10, c11, c12, c13, c14, c15; /* N, factors of T_1(x') T_j(v') */
  double c20, c21, c22, c23, c24, c25; /* N, factors of T_2(x') T_j(v') */
  double x_mid;                        /* m, middle of the stroke */
  double x_half;                       /* m, half of the stroke */
  double v_half;                       /* m/s, half of the span of velocity */
} Chebyshev;

static inline double chebyshev_force(const Chebyshev* p, double x, double v, const double* z) {
  const double s = fmin(fmax((x - p->x_mid) / p->x_half, -1), 1);
  const double t = fmin(fmax(v / p->v_half, -1), 1);
  const double t2 = 2 * t * t - 1;
  const double t3 = 2 * t * t2 - t;
  const double t4 = 2 * t * t3 - t2;
  const double t5 = 2 * t * t4 - t3;
  const double row0 = p->f0 + p->c01 * t + p->c02 * t2 + p->c03 * t3 + p->c04 * t4 + p->c05 * t5;
  const double row1 = p->c10 + p->c11 * t + p->c12 * t2 + p->c13 * t3 + p->c14 * t4 + p->c15 * t5;
  const double row2 = p->c20 + p->c21 * t + p->c22 * t2 + p->c23 * t3 + p->c24 * t4 + p->c25 * t5;
  (void)z;
  return row0 + s * row1 + (2 * s * s - 1) * row2;
}

#endif
