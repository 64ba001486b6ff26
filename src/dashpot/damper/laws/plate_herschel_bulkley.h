/* Quasi-static flow of a Herschel-Bulkley fluid, tau = tau_y + K rate^n, through a gap between
 * plates (valve mode).
 *
 *   F = sgn(v) G + f0,   (G - Y) ((1 - r) (1 + n r / (n + 1)))^n = f_v (|v| / v_r)^n,   r = Y / G,
 * Y = f_y
 *
 * v m/s (extension positive); F N, same sign as v, sgn(0) = 0. No internal state, no hysteresis.
 * n < 1: shear thinning; n = 1 is plate_bingham with c0 = f_v / v_r. Piston area A, gap length L,
 * width w, height h: f_y = 2 tau_y L A / h,   f_v = 2 K L A / h (2 (1/n + 2) A v_r / (w h^2))^n.
 * v_s > 0: f_y tanh(|v| / v_s) in place of f_y. Source: N. M. Wereley, J. Intell. Mater. Syst.
 * Struct. 19 (2008) 257-268, and X. Wang, F. Gordaninejad, same journal 10 (1999) 601-608. Differs
 * from them: v_s; f_v in place of K.
 */
#ifndef DASHPOT_LAW_PLATE_HERSCHEL_BULKLEY_H
#define DASHPOT_LAW_PLATE_HERSCHEL_BULKLEY_H
#include "../../physics/plate_flow.h"

typedef struct PlateHerschelBulkley {
  double f_v; /* N, force at speed v_r without yield stress */
  double f_y; /* N, force below which nothing flows */
  double n;   /* 1, exponent of the shear rate */
  double v_r; /* m/s, speed at which f_v is meant */
  double f0;  /* N, offset: accumulator */
  double v_s; /* m/s, speed over which the yield stress sets in; 0: at once */
} PlateHerschelBulkley;

static inline double plate_herschel_bulkley_force(const PlateHerschelBulkley* p, double x, double v,
                                                  const double* z) {
  const double power = fmax(p->f_v, 0) * pow(fabs(v) / p->v_r, p->n);
  const double yielding = fmax(p->f_y, 0) * plate_onset(v, p->v_s);
  (void)x, (void)z;
  return plate_side(v) * plate_herschel_bulkley_pressure(power, yielding, p->n) + p->f0;
}

#endif
