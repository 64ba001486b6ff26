/* Modified LuGre: bristles that bend until they slip, and viscous damping.
 *
 *   z' = v - a_0 |v| z,   |z| <= 1 / a_0
 *   F  = sigma_0 z + sigma_1 z' + sigma_2 v + f0
 *
 * v m/s (extension positive); F N, same sign as v. State: z m, at rest 0.
 * Dissipates whatever the parameters, for |z| <= 1 / a_0. Source: C. Sakai, H. Ohmori, A. Sano,
 * Proc. IEEE CDC (2003) 2668-2673; R. Jimenez, L. Alvarez-Icaza, Structural Control and Health
 * Monitoring 12 (2005) 45-64. Differs from them: sigma_a + sigma_0 V there is sigma_0 here, and
 * sigma_2 + sigma_b V is sigma_2: dependence on the drive is the same for every law; f0.
 */
#ifndef DASHPOT_LAW_MODIFIED_LUGRE_H
#define DASHPOT_LAW_MODIFIED_LUGRE_H
#include "dahl.h"

typedef struct ModifiedLugre {
  double sigma_0; /* N/m, stiffness of the bristles */
  double sigma_1; /* N*s/m, their damping */
  double sigma_2; /* N*s/m, viscous damping */
  double a_0;     /* 1/m, their bend at slip is 1 / a_0 */
  double f0;      /* N, offset */
} ModifiedLugre;

static inline void modified_lugre_rest(const ModifiedLugre* p, double x, double v, double* z) {
  (void)p, (void)x, (void)v;
  z[0] = 0;
}

static inline void modified_lugre_derivative(const ModifiedLugre* p, double x, double v,
                                             const double* z, double* dz) {
  (void)x;
  dz[0] = v - p->a_0 * fabs(v) * z[0];
}

static inline double modified_lugre_force(const ModifiedLugre* p, double x, double v,
                                          const double* z) {
  double dz;
  modified_lugre_derivative(p, x, v, z, &dz);
  return p->sigma_0 * z[0] + p->sigma_1 * dz + p->sigma_2 * v + p->f0;
}

/* z after a displacement s of either sign */
static inline double modified_lugre_travel(const ModifiedLugre* p, double z, double s) {
  return dahl_move(p->a_0, p->a_0 * z, s) / p->a_0;
}

/* 1/s: how fast z settles at speed v */
static inline double modified_lugre_rate(const ModifiedLugre* p, double v) {
  return p->a_0 * fabs(v);
}

#endif
