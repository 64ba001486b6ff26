/* Bouc-Wen (simple): viscous damping, a spring and a hysteresis force in parallel.
 *
 *   z' = A v - gamma |v| z |z|^(n-1) - beta v |z|^n
 *   F  = c0 v + k0 (x - x0) + alpha z + f0
 *
 * x m, v m/s (extension positive); F N, same sign as v. State: z m, at rest 0.
 * gamma multiplies |v| z: gamma and beta change places between papers. z may be rescaled by any s >
 * 0 with alpha / s, s A, gamma / s^(n-1), beta / s^(n-1): only three of alpha, A, gamma, beta are
 * independent. |z| settles at z_max = (A / (gamma + beta))^(1/n). Source: Y. K. Wen, J. Eng. Mech.
 * Div. 102 (1976) 249-263; as written by B. F. Spencer, S. J. Dyke, M. K. Sain, J. D. Carlson, J.
 * Eng. Mech. 123 (1997) 230-238. Differs from it: f0.
 */
#ifndef DASHPOT_LAW_BOUC_WEN_H
#define DASHPOT_LAW_BOUC_WEN_H
#include "normalised_bouc_wen.h"

typedef struct BoucWen {
  double alpha; /* N/m, hysteresis gain */
  double c0;    /* N*s/m, viscous damping */
  double k0;    /* N/m, stiffness */
  double x0;    /* m, where the spring is relaxed */
  double gamma; /* 1/m^2, loop shape: multiplies |v| z |z|^(n-1); the unit holds for n = 2 */
  double beta;  /* 1/m^2, loop shape: multiplies v |z|^n */
  double A;     /* 1, loop slope */
  double n;     /* 1, sharpness of the knee */
  double f0;    /* N, offset */
} BoucWen;

static inline double bouc_wen_z_max(double A, double gamma, double beta, double n) {
  const double ratio = A / (gamma + beta);
  return n == 2 ? sqrt(ratio) : pow(ratio, 1 / n);
}

static inline void bouc_wen_derivative(const BoucWen* p, double x, double v, const double* z,
                                       double* dz) {
  const double u = fabs(z[0]), power = p->n == 2 ? u : pow(u, p->n - 1);
  (void)x;
  dz[0] = p->A * v - power * (p->gamma * fabs(v) * z[0] + p->beta * v * u);
}

static inline double bouc_wen_force(const BoucWen* p, double x, double v, const double* z) {
  return p->c0 * v + p->k0 * (x - p->x0) + p->alpha * z[0] + p->f0;
}

#ifndef DASHPOT_LAW_IN_LANES /* branches that differ from lane to lane */
static inline void bouc_wen_rest(const BoucWen* p, double x, double v, double* z) {
  (void)p, (void)x, (void)v;
  z[0] = 0;
}

/* z after a displacement s of either sign */
static inline double bouc_wen_travel(const BoucWen* p, double z, double s) {
  const double z_max = bouc_wen_z_max(p->A, p->gamma, p->beta, p->n);
  const double sigma = p->gamma / (p->gamma + p->beta);
  return z_max * normalised_bouc_wen_move(sigma, p->n, z / z_max, p->A / z_max * s);
}
#endif

/* 1/s: how fast z settles at speed v */
static inline double bouc_wen_rate(const BoucWen* p, double v) {
  return p->n * p->A * fabs(v) / bouc_wen_z_max(p->A, p->gamma, p->beta, p->n);
}

#endif
