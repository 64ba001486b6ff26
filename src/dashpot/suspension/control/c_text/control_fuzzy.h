/* Fuzzy: c = c_min + (c_max - c_min) sum of w r. A velocity over its scale, held within -1 ... 1,
 * is negative, nearly zero and positive to the degrees max(0, -u), 1 - |u|, max(0, u); w are the
 * products of the degrees of z' and d, r the rules:
 *
 *               d negative   zero   positive
 *   z' negative          1    1/2          0
 *   zero               1/2      0        1/2
 *   positive             0    1/2          1
 */
#include "demand.h"

typedef struct Fuzzy {
  double body, deflection; /* m/s, scales of z' and d */
} Fuzzy;

static inline double fuzzy_degree(double velocity, double scale) {
  const double u = velocity / scale;
  return (u > -1) ? ((u < 1) ? u : 1) : -1; /* -1 for what is no number */
}

static inline DamperDemand fuzzy_demand(const Fuzzy* p, const ControlLimits* limits,
                                        const StrutSignals* s) {
  const double z = fuzzy_degree(s->body_velocity, p->body);
  const double d = fuzzy_degree(s->deflection_velocity, p->deflection);
  const double a = fabs(z), b = fabs(d);
  const double alike = ((z * d) > 0) ? (a * b) : 0;
  const double share = alike + (0.5 * ((a * (1 - b)) + ((1 - a) * b)));
  return demand_of(kDemandDamping,
                   limits->damping_min + (share * (limits->damping_max - limits->damping_min)));
}
