/* Hyperbolic tangent of Kwok: hysteresis without internal state.
 *
 *   F = c v + k x + alpha tanh(beta v + delta sgn(x)) + f0,   sgn(0) = 0
 *
 * x m, v m/s (extension positive); F N, same sign as v.
 * The sign of x carries the history of a motion that is centred on x = 0: subtract the mean stroke
 * first. The force jumps where the stroke crosses zero, visibly so at low speed. Source: N. M.
 * Kwok, Q. P. Ha, T. H. Nguyen, J. Li, B. Samali, Sensors and Actuators A 132 (2006) 441-451.
 * Differs from it: nothing.
 */
#ifndef DASHPOT_LAW_TANH_KWOK_H
#define DASHPOT_LAW_TANH_KWOK_H
#include <math.h>

typedef struct TanhKwok {
  double c;     /* N*s/m, viscous damping */
  double k;     /* N/m, stiffness */
  double alpha; /* N, height of the hysteresis */
  double beta;  /* s/m, steepness */
  double delta; /* 1, half width of the hysteresis in beta v */
  double f0;    /* N, offset */
} TanhKwok;

static inline double tanh_kwok_force(const TanhKwok* p, double x, double v, const double* z) {
  const double side = (double)((x > 0) - (x < 0));
  (void)z;
  return p->c * v + p->k * x + p->alpha * tanh(p->beta * v + p->delta * side) + p->f0;
}

#endif
