/* Modified Bouc-Wen (phenomenological model): a Bouc-Wen element and a dashpot c0 in series with a
 * dashpot c1.
 *
 *   y' = (alpha z + c0 v + k0 (x - y)) / (c0 + c1)
 *   z' = A w - gamma |w| z |z|^(n-1) - beta w |z|^n,   w = v - y'
 *   F  = alpha z + c0 w + k0 (x - y) + k1 (x - x0) + f0   ( = c1 y' + k1 (x - x0) + f0 )
 *
 * x m, v m/s (extension positive); F N, same sign as v. States: y m, z m. At rest y = x and z = 0.
 * gamma multiplies |w| z: gamma and beta change places between papers. z may be rescaled by any s >
 * 0 with alpha / s, s A, gamma / s^(n-1), beta / s^(n-1): only three of alpha, A, gamma, beta are
 * independent. |z| settles at (A / (gamma + beta))^(1/n). Source: B. F. Spencer, S. J. Dyke, M. K.
 * Sain, J. D. Carlson, J. Eng. Mech. 123 (1997) 230-238. Differs from it: f0, which is 0 there.
 */
#ifndef DASHPOT_LAW_MODIFIED_BOUC_WEN_H
#define DASHPOT_LAW_MODIFIED_BOUC_WEN_H
#include "bouc_wen.h"

typedef struct ModifiedBoucWen {
  double alpha; /* N/m, hysteresis gain */
  double c0;    /* N*s/m, damping at high speed */
  double c1;    /* N*s/m, damping in series: the roll-off at low speed */
  double k0;    /* N/m, stiffness at high speed */
  double k1;    /* N/m, accumulator stiffness */
  double x0;    /* m, where the accumulator spring is relaxed */
  double gamma; /* 1/m^2, loop shape: multiplies |w| z |z|^(n-1); the unit holds for n = 2 */
  double beta;  /* 1/m^2, loop shape: multiplies w |z|^n */
  double A;     /* 1, loop slope */
  double n;     /* 1, sharpness of the knee */
  double f0;    /* N, offset */
} ModifiedBoucWen;

/* |z|^(n-1) */
static inline double modified_bouc_wen_power(const ModifiedBoucWen* p, double z) {
  return p->n == 2 ? fabs(z) : pow(fabs(z), p->n - 1);
}

/* y'; the division does not wait for the states */
static inline double modified_bouc_wen_series_speed(const ModifiedBoucWen* p, double x, double v,
                                                    const double* z) {
  const double ease = 1 / (p->c0 + p->c1);
  return (p->alpha * z[1] + p->c0 * v + p->k0 * (x - z[0])) * ease;
}

static inline void modified_bouc_wen_derivative(const ModifiedBoucWen* p, double x, double v,
                                                const double* z, double* dz) {
  const double dy = modified_bouc_wen_series_speed(p, x, v, z);
  const double w = v - dy;
  dz[0] = dy;
  dz[1] = p->A * w -
          modified_bouc_wen_power(p, z[1]) * (p->gamma * fabs(w) * z[1] + p->beta * w * fabs(z[1]));
}

static inline double modified_bouc_wen_force(const ModifiedBoucWen* p, double x, double v,
                                             const double* z) {
  const double w = v - modified_bouc_wen_series_speed(p, x, v, z);
  return p->alpha * z[1] + p->c0 * w + p->k0 * (x - z[0]) + p->k1 * (x - p->x0) + p->f0;
}

#ifndef DASHPOT_LAW_IN_LANES /* branches that differ from lane to lane */
static inline void modified_bouc_wen_rest(const ModifiedBoucWen* p, double x, double v, double* z) {
  (void)p;
  (void)v;
  z[0] = x;
  z[1] = 0;
}

/* States after a step of length h in which x and v go linearly from x[0], v[0] to x[1], v[1].
 * Second order, stable and bounded at any length: z travels exactly along its loop, over the
 * distance w h at whose speed w the equation of y' holds in the mean. In the direction of motion
 * that equation is monotone, so Newton's method within a bracket finds w. */
static inline int modified_bouc_wen_step(const ModifiedBoucWen* p, const double* x, const double* v,
                                         double h, double* z) {
  const double z_max = bouc_wen_z_max(p->A, p->gamma, p->beta, p->n);
  const double sigma = p->gamma / (p->gamma + p->beta);
  const double mean_v = 0.5 * (v[0] + v[1]);
  const double drag = p->c0 + p->c1 + 0.5 * h * p->k0;
  const double push = p->c1 * mean_v - p->k0 * (0.5 * (x[0] + x[1]) - z[0] - 0.5 * h * mean_v);

  /* drag w + alpha (z0 + z1(w)) / 2 = push, mirrored so that w >= 0 */
  const double side = push >= p->alpha * z[1] ? 1 : -1;
  const double z0 = side * z[1], share = 0.5 * p->alpha;
  double low = 0, high = (side * push - p->alpha * z0) / drag;
  double w =
      high * drag /
      (drag + share * h * p->A * fmax(0, normalised_bouc_wen_slope(sigma, p->n, z0 / z_max)));
  double z1 = z0;
  int k;

  /* Newton's method for w within low ... high, by halving where it would leave them. */
  for (k = 0; k < 60; ++k) {
    const double end = normalised_bouc_wen_rise(sigma, p->n, z0 / z_max, p->A / z_max * w * h);
    const double tolerance = 1e-7; /* single precision: 1e-5 */
    double excess, slope, next;
    z1 = z_max * end;
    excess = drag * w + share * (z0 + z1) - side * push;
    slope = p->A * normalised_bouc_wen_slope(sigma, p->n, end);
    next = w - excess / (drag + share * h * slope);
    if (fabs(next - w) <= tolerance * high) { /* the next step would move by the square of this */
      z1 = fmin(z1 + slope * h * (next - w), fmax(z0, z_max));
      z1 = fmax(z1, fmin(z0, z_max)); /* it stays between its start and where it settles */
      w = next;
      break;
    }
    if (excess > 0)
      high = w;
    else
      low = w;
    w = next >= low && next <= high ? next : 0.5 * (low + high);
  }

  z[0] += h * (mean_v - side * w);
  z[1] = side * z1;
  return 1;
}
#endif

/* 1/s: bound of the rate at which z settles and y creeps, at speed v */
static inline double modified_bouc_wen_rate(const ModifiedBoucWen* p, double v) {
  const double z_max = bouc_wen_z_max(p->A, p->gamma, p->beta, p->n);
  const double drag = p->c0 + p->c1;
  const double w = fabs(v) + p->alpha * z_max / drag;
  return p->n * p->A * w / z_max + (p->alpha * p->A + p->k0) / drag;
}

#endif
