/* Quasi-static flow of a Bingham fluid through a gap between plates, driven by the piston (valve
 * mode).
 *
 *   F = sgn(v) G + f0
 *   G^3 - (N + 3/2 Y) G^2 + Y^3 / 2 = 0, its largest root,   N = c0 |v|,   Y = f_y
 *
 * v m/s (extension positive); F N, same sign as v, sgn(0) = 0. No internal state, no hysteresis.
 * Piston area A, gap length L, width w, height h, viscosity eta and yield stress tau enter through
 * two numbers only, c0 = 12 eta L A^2 / (w h^3) and f_y = 2 tau L A / h, which is why no measured
 * force tells geometry from fluid. From f_y at v -> 0 the yielding part of G grows to 3/2 f_y at
 * high speed. v_s > 0: f_y tanh(|v| / v_s) in place of f_y, without a jump. Sources: R. W.
 * Phillips, thesis, UC Berkeley 1969; N. M. Wereley, L. Pang, Smart Mater. Struct. 7 (1998)
 * 732-743. Differs from them: v_s.
 */
#ifndef DASHPOT_LAW_PLATE_BINGHAM_H
#define DASHPOT_LAW_PLATE_BINGHAM_H
#include "../../physics/plate_flow.h"

typedef struct PlateBingham {
  double c0;  /* N*s/m, damping without yield stress */
  double f_y; /* N, force below which nothing flows */
  double f0;  /* N, offset: accumulator */
  double v_s; /* m/s, speed over which the yield stress sets in; 0: at once */
} PlateBingham;

static inline double plate_bingham_force(const PlateBingham* p, double x, double v,
                                         const double* z) {
  const double newtonian = fmax(p->c0, 0) * fabs(v),
               yielding = fmax(p->f_y, 0) * plate_onset(v, p->v_s);
  (void)x, (void)z;
  return plate_side(v) * plate_bingham_pressure(newtonian, yielding) + p->f0;
}

#endif
