/* Two chambers of equal volume with a compressible Bingham fluid, joined by a gap between plates.
 *
 *   e' = v - sgn(e) N(k |e|) / c0,   N(G) = G (1 - Y/G)^2 (1 + Y/(2 G)) for G > Y, else 0,   Y =
 * f_y F  = k e + f_f sgn(v) + f0
 *
 * v m/s (extension positive); F N, same sign as v. State: e m, the stroke that compression has
 * taken up; k e is the pressure difference times the piston area A. At rest e = 0. With bulk
 * modulus beta and chamber volume V: k = 2 beta A^2 / V; c0 and f_y as in plate_bingham, whose
 * inverse N is. Equations: the flow balance beta / V (A v - Q) of each chamber, as in MR damper
 * models with compressible flow (J. Intell. Mater. Syst. Struct. 2014, 10.1177/1045389X13500576,
 * known by its abstract). Differs from them: equal and constant volumes.
 */
#ifndef DASHPOT_LAW_COMPRESSIBLE_CHAMBERS_H
#define DASHPOT_LAW_COMPRESSIBLE_CHAMBERS_H
#include "../../physics/plate_flow.h"

typedef struct CompressibleChambers {
  double c0;  /* N*s/m, damping without yield stress */
  double f_y; /* N, force below which nothing flows */
  double k;   /* N/m, stiffness of the fluid in both chambers */
  double f_f; /* N, friction of the seals */
  double f0;  /* N, offset: accumulator */
} CompressibleChambers;

static inline void compressible_chambers_rest(const CompressibleChambers* p, double x, double v,
                                              double* z) {
  (void)p, (void)x, (void)v;
  z[0] = 0;
}

static inline void compressible_chambers_derivative(const CompressibleChambers* p, double x,
                                                    double v, const double* z, double* dz) {
  const double newtonian = plate_bingham_newtonian(p->k * fabs(z[0]), fmax(p->f_y, 0));
  (void)x;
  dz[0] = v - plate_side(z[0]) * newtonian / p->c0;
}

static inline double compressible_chambers_force(const CompressibleChambers* p, double x, double v,
                                                 const double* z) {
  (void)x;
  return p->k * z[0] + p->f_f * plate_side(v) + p->f0;
}

/* G where G + ratio N(G) = sum, odd in sum. Convex for G > Y: from a bound above the root Newton's
 * method falls to it and stays above. */
static inline double compressible_chambers_solve(double sum, double yielding, double ratio) {
  const double top = fabs(sum);
  double g = fmin(top, (top + 1.5 * ratio * yielding) / (1 + ratio));
  int k;
  if (top <= yielding) return sum;
  for (k = 0; k < 60; ++k) {
    const double r = yielding / g, r3 = r * r * r;
    const double excess = g + ratio * plate_bingham_newtonian(g, yielding) - top;
    const double step = excess / (1 + ratio * (1 - fmin(r3, 1)));
    const double tolerance = 1e-8; /* single precision: 1e-5 */
    g -= step;
    if (fabs(step) <= tolerance * g) break; /* the next step would move by the square of this */
  }
  return plate_side(sum) * g;
}

/* State after a step of length h in which v goes linearly from v[0] to v[1]: the two-stage
 * diagonally implicit Runge-Kutta method of order 2 that damps any rate (R. Alexander, SIAM J.
 * Numer. Anal. 14 (1977) 1006-1021). */
static inline int compressible_chambers_step(const CompressibleChambers* p, const double* x,
                                             const double* v, double h, double* z) {
  const double part = 0.29289321881345247560; /* 1 - 1 / sqrt(2) */
  const double push = part * h * p->k, ratio = push / p->c0, yielding = fmax(p->f_y, 0);
  const double start = p->k * z[0];
  const double middle =
      compressible_chambers_solve(start + push * (v[0] + part * (v[1] - v[0])), yielding, ratio);
  const double carried = start + (1 - part) / part * (middle - start);
  (void)x;
  z[0] = compressible_chambers_solve(carried + push * v[1], yielding, ratio) / p->k;
  return 1;
}

/* 1/s: bound of the rate at which the pressure settles through the gap */
static inline double compressible_chambers_rate(const CompressibleChambers* p, double v) {
  (void)v;
  return p->k / p->c0;
}

#endif
