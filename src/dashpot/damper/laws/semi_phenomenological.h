/* Semi-phenomenological (SP) law: a hyperbolic tangent of velocity and position beside a dashpot
 * and a spring.
 *
 *   F = alpha tanh(a1 v + a2 x) + b1 v + b2 x + f0
 *
 * x m, v m/s (extension positive); F N, same sign as v. No internal state. a2 > 0 turns the loop
 * the right way round; b2 < 0 is a negative stiffness. Assumes a motion centred on x = 0: subtract
 * the mean stroke. Source: S. Guo, S. Yang, C. Pan, J. Intell. Mater. Syst. Struct. 17 (2006) 3-14,
 * in the form of the one-sensor paper (alpha = f_c i) and of C. Poussot-Vassal's damper model.
 * Differs from them: f0, and that any coefficient may depend on the current.
 */
#ifndef DASHPOT_LAW_SEMI_PHENOMENOLOGICAL_H
#define DASHPOT_LAW_SEMI_PHENOMENOLOGICAL_H
#include <math.h>

typedef struct SemiPhenomenological {
  double alpha; /* N, controllable force */
  double a1;    /* s/m, steepness over velocity */
  double a2;    /* 1/m, steepness over position: the width of the loop */
  double b1;    /* N*s/m, viscous damping */
  double b2;    /* N/m, stiffness */
  double f0;    /* N, offset */
} SemiPhenomenological;

static inline double semi_phenomenological_force(const SemiPhenomenological* p, double x, double v,
                                                 const double* z) {
  (void)z;
  return p->alpha * tanh(p->a1 * v + p->a2 * x) + p->b1 * v + p->b2 * x + p->f0;
}

#endif
