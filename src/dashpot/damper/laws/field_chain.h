/* From coil current to force by physics: magnetic circuit, field in the fluid, yield stress, flow
 * through the gap.
 *
 *   B_c = mu0 turns |i| / (core_length / permeability + gap_length),   B = B_sat B_c / (B_c +
 * B_sat) H = a1 B + a3 B^3,   tau = b0 + b1 H + b2 H^2 + b3 H^3, held at its maximum tau_max:   the
 * fluid MRF-140CG F = sgn(v) (G + f_f) + f0,   G as in plate_bingham with Y = f_m tau / tau_max
 *
 * v m/s (extension positive); F N, same sign as v, sgn(0) = 0; i A. No internal state, no
 * hysteresis. f_m = 2 tau_max L A / h, c0 = 12 eta L A^2 / (w h^3). The area of the circuit
 * cancels. Source: equations 2 to 11 and table 1 of the family paper (Duchanoy et al. 2019).
 * Differs from it: tau is held beyond its maximum; the flow is the exact one of plate_bingham in
 * place of its equations 13 to 15; friction f_f.
 */
#ifndef DASHPOT_LAW_FIELD_CHAIN_H
#define DASHPOT_LAW_FIELD_CHAIN_H
#include "../../physics/magnetic_circuit.h"
#include "../../physics/plate_flow.h"

typedef struct FieldChain {
  double c0;           /* N*s/m, damping without yield stress */
  double f_m;          /* N, force below which nothing flows, at the fluid's largest yield stress */
  double f_f;          /* N, friction of the seals */
  double turns;        /* 1, of the coil */
  double current;      /* A, in the coil */
  double core_length;  /* m, of the magnetic path in steel */
  double gap_length;   /* m, of the magnetic path across the gap */
  double permeability; /* 1, relative, of the steel */
  double B_sat;        /* T, flux density that the steel tends to */
  double f0;           /* N, offset: accumulator */
  double v_s;          /* m/s, speed over which friction and yield stress set in; 0: at once */
} FieldChain;

/* Pa */
static inline double field_chain_yield_stress(const FieldChain* p) {
  const MagneticCircuit circuit = {
      p->turns, p->core_length, p->gap_length, 1, p->permeability, p->B_sat, 1};
  return family_yield_stress(
      &kFamily140CG, family_field(&kFamily140CG, circuit_flux_density(&circuit, fabs(p->current))));
}

static inline double field_chain_force(const FieldChain* p, double x, double v, const double* z) {
  const double largest = family_yield_stress(&kFamily140CG, kFamily140CG.held_field);
  const double yielding = p->f_m * field_chain_yield_stress(p) / largest,
               onset = plate_onset(v, p->v_s);
  (void)x, (void)z;
  return plate_side(v) *
             (plate_bingham_pressure(p->c0 * fabs(v), yielding * onset) + p->f_f * onset) +
         p->f0;
}

#endif
