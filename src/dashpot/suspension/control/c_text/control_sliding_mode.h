/* Sliding mode: the body shall move like one on the same springs under a skyhook damper,
 * m w' = -k x - C w. On s = z' - w the force F = C w + m n sat(s / b) gives s' = -n sat(s / b);
 * within c_min d ... c_max d. memory: w, m/s.
 */
#include "dissipating_force.h"

typedef struct SlidingMode {
  double damping;   /* C, N*s/m */
  double reaching;  /* n, m/s^2 */
  double layer;     /* b, m/s */
  double mass;      /* m, kg */
  double stiffness; /* k, N/m */
  double step;      /* s, from sample to sample */
} SlidingMode;

static inline DamperDemand sliding_mode_demand(const SlidingMode* p, const ControlLimits* limits,
                                               const StrutSignals* s, double* memory) {
  /* The model's velocity, by a step that is stable however long it is. */
  const double spring = (isfinite(s->deflection) != 0) ? (p->stiffness * s->deflection) : 0;
  memory[0] = (memory[0] - (p->step * spring / p->mass)) / (1 + (p->step * p->damping / p->mass));

  const double distance = (s->body_velocity - memory[0]) / p->layer;
  const double pull = (distance > -1) ? ((distance < 1) ? distance : 1) : -1;
  const double force = (p->damping * memory[0]) + (p->mass * p->reaching * pull);
  return dissipating_force(force, s->deflection_velocity, limits);
}
