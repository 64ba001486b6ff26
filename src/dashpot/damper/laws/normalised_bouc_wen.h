/* Normalised Bouc-Wen: viscous damping and a hysteresis force whose state has no scale of its own.
 *
 *   w' = rho (v - sigma |v| |w|^(n-1) w + (sigma - 1) v |w|^n),   |w| <= 1
 *   F  = kappa_x v + kappa_w w + f0
 *
 * v m/s (extension positive); F N, same sign as v. State: w, at rest 0.
 * The same as z' = A v - gamma |v| z |z|^(n-1) - beta v |z|^n with rho = A / z_max, sigma = gamma /
 * (gamma + beta), w = z / z_max, z_max = (A / (gamma + beta))^(1/n). sigma > 1 is a negative beta.
 * Source: F. Ikhouane, J. Rodellar, Systems with Hysteresis (Wiley 2007). Differs from it: f0.
 */
#ifndef DASHPOT_LAW_NORMALISED_BOUC_WEN_H
#define DASHPOT_LAW_NORMALISED_BOUC_WEN_H
#include <math.h>

typedef struct NormalisedBoucWen {
  double kappa_x; /* N*s/m, viscous damping */
  double kappa_w; /* N, hysteresis force at saturation */
  double rho;     /* 1/m, steepness: 1 / rho is the knee */
  double sigma;   /* 1, how much steeper w leaves a saturation than zero */
  double n;       /* 1, sharpness of the knee */
  double f0;      /* N, offset */
} NormalisedBoucWen;

/* |w|^n */
static inline double normalised_bouc_wen_power(double n, double w) {
  return n == 2 ? w * w : n == 1 ? fabs(w) : pow(fabs(w), n);
}

/* dw/ds at w, moving towards larger w; s = rho x */
static inline double normalised_bouc_wen_slope(double sigma, double n, double w) {
  return 1 + (w > 0 ? -1 : 2 * sigma - 1) * normalised_bouc_wen_power(n, w);
}

#ifndef DASHPOT_LAW_IN_LANES /* branches that differ from lane to lane */
static inline void normalised_bouc_wen_rest(const NormalisedBoucWen* p, double x, double v,
                                            double* z) {
  (void)p, (void)x, (void)v;
  z[0] = 0;
}

/* For any n: each step goes along the straight line that touches the slope at its start, in closed
 * form. */
static inline double normalised_bouc_wen_travel_by_tangents(double sigma, double n, double w,
                                                            double s) {
  const double fastest = n * (w > 0 ? 1 : fmax(1, fabs(2 * sigma - 1)));
  const int count = 1 + (int)fmin(4 * s * fastest, 31);
  int k;
  s /= (double)count;
  for (k = 0; k < count && 1 - w > 1e-12; ++k) {
    const double power = pow(fabs(w), n - 1), share = w > 0 ? -1 : 1 - 2 * sigma;
    const double slope = 1 + (w > 0 ? -w : (1 - 2 * sigma) * w) * power, bend = n * share * power;
    w = fmin(1, w + slope * (bend == 0 ? s : expm1(bend * s) / bend));
  }
  return w;
}

/* w < 0 after a travel of s >= 0 towards larger w, n = 1 or 2; what is left of s when w arrives at
 * 0 */
static inline double normalised_bouc_wen_travel_below_zero(double sigma, double n, double w,
                                                           double* s) {
  const double b = 2 * sigma - 1, r = sqrt(fabs(b));
  double to_zero;

  /* The travel after which w arrives at 0; the rest is left to the other side. */
  if (b == 0)
    to_zero = -w;
  else if (n == 1)
    to_zero = log1p(-b * w) / b;
  else
    to_zero = (b > 0 ? atan(-r * w) : atanh(-r * w)) / r;
  if (*s >= to_zero) {
    *s -= to_zero;
    return 0;
  }

  /* It does not get there: w after the whole travel. */
  if (b == 0)
    w += *s;
  else if (n == 1)
    w = w * exp(-b * *s) - expm1(-b * *s) / b;
  else {
    const double t = b > 0 ? tan(r * *s) : tanh(r * *s);
    w = (w + t / r) / (1 - b * w * t / r);
  }
  *s = 0;
  return w;
}

/* w after a travel of s = rho x >= 0 towards larger w, in closed form for n = 1 and 2 */
static inline double normalised_bouc_wen_rise(double sigma, double n, double w, double s) {
  if (2 * sigma < 1) w = fmax(w, -1); /* beyond, w would run away */
  if (n != 1 && n != 2) return normalised_bouc_wen_travel_by_tangents(sigma, n, w, s);
  if (w < 0) w = normalised_bouc_wen_travel_below_zero(sigma, n, w, &s);
  if (s == 0) return w;
  if (n == 1) return w - (1 - w) * expm1(-s);
  s = tanh(s);
  return (w + s) / (1 + w * s);
}

/* w after a travel of s = rho x of either sign */
static inline double normalised_bouc_wen_move(double sigma, double n, double w, double s) {
  return s >= 0 ? normalised_bouc_wen_rise(sigma, n, w, s)
                : -normalised_bouc_wen_rise(sigma, n, -w, -s);
}

static inline double normalised_bouc_wen_travel(const NormalisedBoucWen* p, double w, double s) {
  return normalised_bouc_wen_move(p->sigma, p->n, w, p->rho * s);
}
#endif

static inline void normalised_bouc_wen_derivative(const NormalisedBoucWen* p, double x, double v,
                                                  const double* z, double* dz) {
  (void)x;
  dz[0] = p->rho * v * normalised_bouc_wen_slope(p->sigma, p->n, v < 0 ? -z[0] : z[0]);
}

static inline double normalised_bouc_wen_force(const NormalisedBoucWen* p, double x, double v,
                                               const double* z) {
  (void)x;
  return p->kappa_x * v + p->kappa_w * z[0] + p->f0;
}

/* 1/s: how fast w settles at speed v */
static inline double normalised_bouc_wen_rate(const NormalisedBoucWen* p, double v) {
  return p->n * p->rho * fabs(v) * fmax(1, fabs(2 * p->sigma - 1));
}

#endif
