/* A coil on a steel core with a gap, as C99: laws and C export share this text. Equations 2 to 8 of
 * the family paper (Duchanoy et al. 2019); its permeability coefficient is read as the relative one
 * times mu0.
 */
#ifndef DASHPOT_MAGNETIC_CIRCUIT_H
#define DASHPOT_MAGNETIC_CIRCUIT_H
#include <math.h>

#include "fluid_curves.h"

typedef struct MagneticCircuit {
  double turns;        /* 1 */
  double core_length;  /* m, of the path in steel */
  double gap_length;   /* m, of the path across the gap */
  double area;         /* m^2, of the cross-section */
  double permeability; /* 1, relative, of the steel */
  double saturation;   /* T, flux density that the steel tends to */
  double
      gap_permeability; /* 1, relative: 1 as in the source; of the fluid where it fills the gap */
} MagneticCircuit;

/* A/Wb */
static inline double core_reluctance(const MagneticCircuit* c) {
  return c->core_length / (c->permeability * DASHPOT_MU0 * c->area);
}
static inline double gap_reluctance(const MagneticCircuit* c) {
  return c->gap_length / (c->gap_permeability * DASHPOT_MU0 * c->area);
}

/* Wb, without saturation */
static inline double magnetic_flux(const MagneticCircuit* c, double current) {
  return c->turns * current / (core_reluctance(c) + gap_reluctance(c));
}

/* T, odd in the flux density without saturation: B_sat B / (|B| + B_sat). A very soft knee, which
 * halves B at B = B_sat: a fit, not physics. */
static inline double saturated_flux_density(double flux_density, double saturation) {
  return saturation * flux_density / (fabs(flux_density) + saturation);
}

/* T, that a coil current drives through the gap */
static inline double circuit_flux_density(const MagneticCircuit* c, double current) {
  return saturated_flux_density(magnetic_flux(c, current) / c->area, c->saturation);
}

#endif
