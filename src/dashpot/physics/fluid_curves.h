/* Field, flux density and yield stress of magnetorheological fluids, as C99: laws and C export
 * share this text. H A/m, B T, yield stress Pa; H and B >= 0, but family_field is odd.
 */
#ifndef DASHPOT_FLUID_CURVES_H
#define DASHPOT_FLUID_CURVES_H
#include <math.h>

#define DASHPOT_MU0 1.25663706212e-6 /* T*m/A, permeability of vacuum */

/* Carlson's empirical laws for iron particles of volume fraction phi (MR fluids and devices in the
 * real world, Int. J. Mod. Phys. B 19 (2005) 1463-1470). carrier: 1.0 hydrocarbon, 1.16 water, 0.95
 * silicone oil.
 */
static inline double carlson_yield_stress(double phi, double carrier, double field) {
  return carrier * 271700 * pow(phi, 1.5239) * tanh(6.33e-6 * field);
}

static inline double carlson_flux_density(double phi, double field) {
  return -1.91 * pow(phi, 1.133) * expm1(-10.97 * DASHPOT_MU0 * field) + DASHPOT_MU0 * field;
}

/* The inverse. B(H) is concave: from H = 0 Newton's method rises to the root and stays below it. */
static inline double carlson_field(double phi, double flux_density) {
  const double iron = 1.91 * pow(phi, 1.133);
  double y = 0; /* mu0 H */
  int k;
  for (k = 0; k < 100; ++k) {
    const double rest = exp(-10.97 * y);
    const double step = (flux_density - y - iron * (1 - rest)) / (1 + 10.97 * iron * rest);
    const double tolerance = 1e-9; /* single precision: 1e-5 */
    y += step;
    if (fabs(step) <= tolerance * y) break; /* the next step would move by the square of this */
  }
  return y / DASHPOT_MU0;
}

/* Table 1 of the family paper (Duchanoy et al. 2019), in SI, without what is round-off there: c0,
 * c2 and c4 of H(B), which is odd. */
typedef struct FamilyFluid {
  double field[2];   /* H = field[0] B + field[1] B^3 */
  double yield[4];   /* tau = yield[0] + yield[1] H + ... */
  double held_field; /* A/m: from here on tau keeps its value; the cubic falls */
} FamilyFluid;

static const FamilyFluid kFamily140CG = {
    {73.468e3, 119.684e3}, {2440.53, 0.5469, -1.42579e-6, 5.357e-13}, 218758.9};

static inline double family_field(const FamilyFluid* fluid, double flux_density) {
  return flux_density * (fluid->field[0] + fluid->field[1] * flux_density * flux_density);
}

static inline double family_yield_stress(const FamilyFluid* fluid, double field) {
  const double h = fmin(field, fluid->held_field);
  const double* c = fluid->yield;
  return c[0] + h * (c[1] + h * (c[2] + h * c[3]));
}

#endif
