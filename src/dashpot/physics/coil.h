/* A coil of wire on a magnetic circuit, as C99. */
#ifndef DASHPOT_COIL_H
#define DASHPOT_COIL_H

typedef struct Coil {
  double turns;         /* 1 */
  double wire_diameter; /* m, of the copper */
  double turn_length;   /* m, mean length of a turn */
  double resistivity;   /* Ohm*m, at 20 degC */
  double coefficient;   /* 1/K, of the resistivity */
} Coil;

static inline double coil_wire_area(const Coil* c) {
  return 0.785398163397448 * c->wire_diameter * c->wire_diameter;
}

/* Ohm, at a temperature in K */
static inline double coil_resistance(const Coil* c, double temperature) {
  const double warm = 1 + c->coefficient * (temperature - 293.15);
  return c->resistivity * warm * c->turns * c->turn_length / coil_wire_area(c);
}

/* H, flux linkage over current; reluctance A/Wb of the whole circuit at that current */
static inline double coil_inductance(const Coil* c, double reluctance) {
  return c->turns * c->turns / reluctance;
}

/* s, of the current behind a step of the voltage */
static inline double coil_time_constant(double inductance, double resistance) {
  return inductance / resistance;
}

#endif
