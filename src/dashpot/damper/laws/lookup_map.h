/* Look-up map: the force over velocity, straight between knots.
 *
 *   F(0) = f0
 *   F(v_max k) = f0 + p1 ... p6,   F(-v_max k) = f0 + n1 ... n6
 *   k = 1/32, 1/16, 1/8, 1/4, 1/2, 1
 *
 * v m/s (extension positive); F N, same sign as v. No internal state, no hysteresis. The knots are
 * denser where the force bends. Beyond v_max the last slope goes on, as a damper's viscous force
 * does, or the last force where that slope falls. The sides are apart from each other: car dampers
 * differ in extension and compression. Source: the force-velocity diagrams of damper makers; no
 * publication.
 */
#ifndef DASHPOT_LAW_LOOKUP_MAP_H
#define DASHPOT_LAW_LOOKUP_MAP_H
#include <math.h>

typedef struct LookupMap {
  double p1, p2, p3, p4, p5, p6; /* N, force at v_max / 32 ... v_max, above f0 */
  double n1, n2, n3, n4, n5, n6; /* N, force at -v_max / 32 ... -v_max, above f0 */
  double v_max;                  /* m/s, speed of the last knot */
  double f0;                     /* N, force at v = 0 */
} LookupMap;

static inline double lookup_map_force(const LookupMap* p, double x, double v, const double* z) {
  const int falling = v < 0;
  const double rise[7] = {0,
                          falling ? -p->n1 : p->p1,
                          falling ? -p->n2 : p->p2,
                          falling ? -p->n3 : p->p3,
                          falling ? -p->n4 : p->p4,
                          falling ? -p->n5 : p->p5,
                          falling ? -p->n6 : p->p6};
  const double u = 32 * fabs(v) / p->v_max; /* knots at 1, 2, 4 ... 32 */
  double knot = 1, slope, magnitude;
  int k = 1;
  (void)x, (void)z;

  /* Find the knot at or beyond this speed; beyond the last one its piece goes on. */
  while (k < 6 && u > knot) {
    knot *= 2;
    ++k;
  }

  /* The straight piece that ends in it. */
  slope = (rise[k] - rise[k - 1]) / (k == 1 ? 1 : 0.5 * knot);
  if (u > 32 && slope < 0) slope = 0;
  magnitude = rise[k] + slope * (u - knot);
  return (falling ? -magnitude : magnitude) + p->f0;
}

#endif
