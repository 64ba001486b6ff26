/* A helical spring, as C99. Stiffness G d^4 / (64 R^3 n), of wire in torsion. Equation 1 of the
 * family paper (Duchanoy et al. 2019) prints 32 in place of 64, which is twice as stiff.
 */
#ifndef DASHPOT_SPRING_H
#define DASHPOT_SPRING_H

typedef struct HelicalSpring {
  double shear_modulus; /* Pa */
  double wire_diameter; /* m */
  double radius;        /* m, of the helix to the middle of the wire */
  double coils;         /* 1, active ones */
} HelicalSpring;

/* N/m */
static inline double spring_stiffness(const HelicalSpring* s) {
  const double d = s->wire_diameter, r = s->radius;
  return s->shear_modulus * d * d * d * d / (64 * r * r * r * s->coils);
}
static inline double spring_stiffness_as_printed(const HelicalSpring* s) {
  return 2 * spring_stiffness(s);
}

#endif
