/* A Bingham fluid sheared between plates, one of which is the piston (shear mode), with
 * Papanastasiou's smooth onset of the yield stress.
 *
 *   F = c0 v + f_y sgn(v) (1 - exp(-|v| / v_s)) + f0;   sgn(v) alone when v_s = 0, sgn(0) = 0
 *
 * v m/s (extension positive); F N, same sign as v. No internal state, no hysteresis.
 * With viscosity eta, yield stress tau, gap height h and sheared area w L: c0 = eta w L / h, f_y =
 * tau w L, v_s = h / m with Papanastasiou's time m. Sources: N. M. Wereley, L. Pang, Smart Mater.
 * Struct. 7 (1998) 732-743; T. C. Papanastasiou, J. Rheol. 31 (1987) 385-404. Differs from them:
 * nothing.
 */
#ifndef DASHPOT_LAW_PLATE_BINGHAM_SHEAR_H
#define DASHPOT_LAW_PLATE_BINGHAM_SHEAR_H
#include "../../physics/plate_flow.h"

typedef struct PlateBinghamShear {
  double c0;  /* N*s/m, viscous damping */
  double f_y; /* N, force of the yield stress */
  double v_s; /* m/s, speed over which the yield stress sets in; 0: at once */
  double f0;  /* N, offset: accumulator */
} PlateBinghamShear;

static inline double plate_bingham_shear_force(const PlateBinghamShear* p, double x, double v,
                                               const double* z) {
  const double smoothing = p->v_s > 0 ? 1 / p->v_s : 0;
  (void)x, (void)z;
  return plate_side(v) * plate_shear_stress(p->c0, p->f_y, fabs(v), smoothing) + p->f0;
}

#endif
