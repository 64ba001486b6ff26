/* Quasi-static flow of a Bingham fluid through an annular gap, one of whose walls is the piston
 * (mixed mode): the wall moves against the flow and drags.
 *
 *   F = sgn(v) (G + D) + f0,   G as in plate_bingham but with a wall that moves at |v|:
 *   3 (P - 2T)^2 (P^3 - (1 + 3T - V) P^2 + 4T^3) + T V^2 P^2 = 0
 *   D = a (G / 2 + a / 12  N G / (G - Y))
 *   P = G / N,   T = Y / (2N),   V = -a / 2,   N = c0 |v|,   Y = f_y
 *
 * v m/s (extension positive); F N, same sign as v, sgn(0) = 0. No internal state, no hysteresis.
 * a = w h / A is the gap's area over the piston's; c0 = 12 eta L A^2 / (w h^3) and f_y = 2 tau L A
 * / h. v_s > 0: f_y tanh(|v| / v_s) in place of f_y. Source: N. M. Wereley, L. Pang, Smart Mater.
 * Struct. 7 (1998) 732-743. Differs from it: D and the sign of V are derived from the velocity
 * profile; v_s.
 */
#ifndef DASHPOT_LAW_PLATE_BINGHAM_MIXED_H
#define DASHPOT_LAW_PLATE_BINGHAM_MIXED_H
#include "../../physics/plate_flow.h"

typedef struct PlateBinghamMixed {
  double c0;  /* N*s/m, damping of the flow without yield stress, walls at rest */
  double f_y; /* N, force below which nothing flows, without the drag */
  double a;   /* 1, area of the gap over that of the piston */
  double f0;  /* N, offset: accumulator */
  double v_s; /* m/s, speed over which the yield stress sets in; 0: at once */
} PlateBinghamMixed;

static inline double plate_bingham_mixed_force(const PlateBinghamMixed* p, double x, double v,
                                               const double* z) {
  const double newtonian = fmax(p->c0, 0) * fabs(v),
               yielding = fmax(p->f_y, 0) * plate_onset(v, p->v_s);
  const double flow = plate_moving_wall_pressure(newtonian, yielding, p->a);
  (void)x, (void)z;
  return plate_side(v) * (flow + plate_wall_drag(flow, newtonian, yielding, p->a)) + p->f0;
}

#endif
