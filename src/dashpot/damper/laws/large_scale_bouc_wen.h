/* Bouc-Wen for large dampers (200 kN): the fluid's mass and shear thinning join the hysteresis.
 *
 *   z' = A v - gamma |v| z |z|^(n-1) - beta v |z|^n
 *   v_f' = a = r (v - v_f)
 *   F  = m a + a1 exp(-(a2 |v|)^p) v + k x + alpha z + f0
 *
 * x m, v m/s (extension positive); F N, same sign as v. States: z m, v_f m/s; at rest z = 0, v_f =
 * v. The acceleration is that of the velocity behind a first-order filter of rate r: far above the
 * motion's own frequencies it is x''. Source: G. Yang, B. F. Spencer, H. J. Jung, J. D. Carlson, J.
 * Eng. Mech. 130 (2004) 1107-1114. Differs from it: the filter.
 */
#ifndef DASHPOT_LAW_LARGE_SCALE_BOUC_WEN_H
#define DASHPOT_LAW_LARGE_SCALE_BOUC_WEN_H
#include "bouc_wen.h"

typedef struct LargeScaleBoucWen {
  double m;     /* kg, equivalent mass of the fluid */
  double a1;    /* N*s/m, damping at low speed */
  double a2;    /* s/m, 1 / a2 is the speed at which damping has fallen to 1/e */
  double p;     /* 1, how suddenly it falls */
  double k;     /* N/m, accumulator stiffness */
  double alpha; /* N/m, hysteresis gain */
  double gamma; /* 1/m^2, loop shape: multiplies |v| z |z|^(n-1); the unit holds for n = 2 */
  double beta;  /* 1/m^2, loop shape: multiplies v |z|^n */
  double A;     /* 1, loop slope */
  double n;     /* 1, sharpness of the knee */
  double r;     /* 1/s, rate of the filter */
  double f0;    /* N, offset */
} LargeScaleBoucWen;

/* The Bouc-Wen law that z follows, without its forces. */
static inline BoucWen large_scale_bouc_wen_loop(const LargeScaleBoucWen* p) {
  BoucWen loop = {0, 0, 0, 0, 0, 0, 0, 0, 0};
  loop.gamma = p->gamma, loop.beta = p->beta, loop.A = p->A, loop.n = p->n;
  return loop;
}

static inline void large_scale_bouc_wen_rest(const LargeScaleBoucWen* p, double x, double v,
                                             double* z) {
  (void)p, (void)x;
  z[0] = 0;
  z[1] = v;
}

static inline void large_scale_bouc_wen_derivative(const LargeScaleBoucWen* p, double x, double v,
                                                   const double* z, double* dz) {
  const BoucWen loop = large_scale_bouc_wen_loop(p);
  bouc_wen_derivative(&loop, x, v, z, dz);
  dz[1] = p->r * (v - z[1]);
}

static inline double large_scale_bouc_wen_force(const LargeScaleBoucWen* p, double x, double v,
                                                const double* z) {
  const double damping = p->a1 * exp(-pow(p->a2 * fabs(v), p->p));
  return p->m * p->r * (v - z[1]) + damping * v + p->k * x + p->alpha * z[0] + p->f0;
}

/* z after a displacement s of either sign */
static inline double large_scale_bouc_wen_travel(const LargeScaleBoucWen* p, double z, double s) {
  const BoucWen loop = large_scale_bouc_wen_loop(p);
  return bouc_wen_travel(&loop, z, s);
}

/* The filter's output is a straight line, too, but for a deviation that decays. */
static inline void large_scale_bouc_wen_filter(const LargeScaleBoucWen* p, const double* v,
                                               double h, double* z) {
  const double behind = (v[1] - v[0]) / (h * p->r);
  z[1] = v[1] - behind + (z[1] - v[0] + behind) * exp(-p->r * h);
}

/* 1/s: how fast z and the filter settle at speed v */
static inline double large_scale_bouc_wen_rate(const LargeScaleBoucWen* p, double v) {
  const BoucWen loop = large_scale_bouc_wen_loop(p);
  return fmax(bouc_wen_rate(&loop, v), p->r);
}

#endif
