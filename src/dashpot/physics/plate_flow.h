/* Flow of a fluid with a yield stress between parallel plates, as C99: laws and C export share this
 * text.
 *
 * A gap (length L, width w, height h) that passes Q costs a pressure which two numbers of the same
 * unit set:
 *
 *   newtonian  N = 12 eta L Q / (w h^3)   the pressure without yield stress, in proportion to Q
 *   yielding   Y = 2 tau L / h            the pressure below which nothing flows
 *
 * Times the piston area they are forces; every function here takes and gives either, for N >= 0 and
 * Y >= 0. In the customary numbers P = p / N and T = w h^2 tau / (12 Q eta) = Y / (2 N). An annular
 * duct is such a gap to the order of (h / diameter)^2.
 *
 * Sources: R. W. Phillips, thesis, UC Berkeley 1969; H. P. Gavin, R. D. Hanson, F. E. Filisko, J.
 * Appl. Mech. 63 (1996) 669-675; N. M. Wereley, L. Pang, Smart Mater. Struct. 7 (1998) 732-743.
 */
#ifndef DASHPOT_PLATE_FLOW_H
#define DASHPOT_PLATE_FLOW_H
#include <math.h>

typedef struct PlateGap {
  double length; /* m, along the flow */
  double width;  /* m, across it */
  double height; /* m, between the plates */
} PlateGap;

/* N, Pa, of a Newtonian fluid of this viscosity, Pa*s, at a flow of m^3/s */
static inline double plate_newtonian_pressure(const PlateGap* gap, double viscosity, double flow) {
  return 12 * viscosity * gap->length * flow /
         (gap->width * gap->height * gap->height * gap->height);
}

/* Y, Pa, of a yield stress in Pa */
static inline double plate_yield_pressure(const PlateGap* gap, double yield_stress) {
  return 2 * yield_stress * gap->length / gap->height;
}

/* Pressure of a Bingham fluid: the largest root of p^3 - (N + 3/2 Y) p^2 + Y^3 / 2 = 0, that is of
 * P^3 - (1 + 3 T) P^2 + 4 T^3 = 0. Of the cosine's angle half is taken, whose sine^2 q^3 and
 * cosine^2 both are sums of positive terms: exact to rounding for any T. */
static inline double plate_bingham_pressure(double newtonian, double yielding) {
  const double a = newtonian + 1.5 * yielding;
  const double q = 1.5 * yielding / a;
  if (!(a > 0)) return 0;
  return a / 3 * (1 + 2 * cos(2. / 3 * atan2(q * sqrt(q), sqrt(newtonian / a * (1 + q + q * q)))));
}

/* The inverse: N at a pressure p >= 0. Nothing flows up to Y. */
static inline double plate_bingham_newtonian(double pressure, double yielding) {
  const double r = yielding / pressure;
  return pressure > yielding ? pressure * (1 - r) * (1 - r) * (1 + 0.5 * r) : 0;
}

/* Gavin's approximation P = 1 + 2.07 T + T / (1 + 0.4 T) of the same: within 2.21 % for T <= 1000
 */
static inline double plate_gavin_pressure(double newtonian, double yielding) {
  const double flowing =
      newtonian > 0 ? yielding * newtonian / (2 * newtonian + 0.4 * yielding) : 0;
  return newtonian + 1.035 * yielding + flowing;
}

/* The same with one wall moving at a speed u against the flow, as a piston's land does: wall = w h
 * u / Q >= 0 is the flow it drags along, over Q; valid up to 3. With V = -wall / 2:
 *
 *   3 (P - 2T)^2 (P^3 - (1 + 3T - V) P^2 + 4T^3) + T V^2 P^2 = 0
 *
 * by Newton's method from the root without the last term, which is small.
 */
static inline double plate_moving_wall_pressure(double newtonian, double yielding, double wall) {
  const double drive = (1 + 0.5 * wall) * newtonian;
  const double small = yielding * wall * wall * newtonian * newtonian / 24;
  double p = plate_bingham_pressure(drive, yielding);
  int k;

  /* In terms of d = p - Y, the pressure beyond yielding. */
  for (k = 0; k < 20 && small > 0; ++k) {
    const double d = p - yielding, s = small / (d * d);
    const double excess = d * d * (d + 1.5 * yielding) - (drive - s) * p * p;
    const double slope = 3 * d * (d + yielding) - 2 * (drive - s + s * p / d) * p;
    const double step = excess / slope;
    const double tolerance = 1e-9; /* single precision: 1e-5 */
    if (!(d > 0 && slope > 0)) break;
    p -= step;
    if (fabs(step) <= tolerance * d) break; /* the next step would move by the square of this */
  }
  return p;
}

/* The moving wall's drag on the piston, as a pressure on its area, where p is
 * plate_moving_wall_pressure */
static inline double plate_wall_drag(double pressure, double newtonian, double yielding,
                                     double wall) {
  const double flowing = pressure - yielding;
  const double shear = flowing > 0 ? newtonian * pressure / flowing : 0;
  return wall * (0.5 * pressure + wall / 12 * shear);
}

/* Pressure of a Herschel-Bulkley fluid, tau = tau_y + K rate^n; `power` is its pressure without
 * yield stress. With d = p / Y - 1:  d (d (d + 1 + b) / (1 + d)^2)^n = power / Y,  b = n / (n + 1).
 * In logarithms the left side is concave and its slope lies between 1 and 1 + n, so that Newton's
 * method converges from any start.
 */
static inline double plate_herschel_bulkley_pressure(double power, double yielding, double n) {
  const double ratio = power / yielding, b = n / (n + 1);
  double d, log_ratio;
  int k;
  if (!(ratio < 1e15)) return yielding > 0 ? power + (1 + b) * yielding : power;
  if (!(ratio > 1e-200)) return yielding;

  /* Start at the sum of both limits, slow and fast flow. */
  log_ratio = log(ratio);
  d = exp(log_ratio / (1 + n)) + ratio;
  for (k = 0; k < 50; ++k) {
    const double e = 1 / (1 + d), f = 1 / (1 + d + b);
    const double excess = log(d) - log_ratio + n * log(d * (d + 1 + b) * e * e);
    const double step = excess / (1 + n * (1 + d * (f - 2 * e)));
    const double tolerance = 1e-8; /* single precision: 1e-5 */
    d *= exp(-step);
    if (fabs(step) <= tolerance) break; /* the next step would move by the square of this */
  }
  return yielding * (1 + d);
}

/* Its `power`, Pa: 2 L / h times the wall stress K (2 (1/n + 2) Q / (w h^2))^n. consistency K,
 * Pa*s^n */
static inline double plate_power_law_pressure(const PlateGap* gap, double consistency, double n,
                                              double flow) {
  const double rate = 2 * (1 / n + 2) * flow / (gap->width * gap->height * gap->height);
  return 2 * gap->length / gap->height * consistency * pow(rate, n);
}

/* Papanastasiou's smooth onset of the yield stress, 1 - exp(-x), for x >= 0: shear rate over its
 * scale */
static inline double plate_papanastasiou(double x) { return -expm1(-x); }

/* Bingham stress, Pa, at a shear rate >= 0; smoothing m in s, 0: none. Times w L: the force of
 * shear mode. */
static inline double plate_shear_stress(double viscosity, double yield_stress, double rate,
                                        double smoothing) {
  return viscosity * rate +
         yield_stress * (smoothing > 0 ? plate_papanastasiou(smoothing * rate) : rate > 0);
}

/* -1, 0, 1: the side on which friction stands */
static inline double plate_side(double v) { return (double)((v > 0) - (v < 0)); }

/* Share of the yield stress that is active at speed |v|: 1, or tanh(|v| / v_s) for a force without
 * a jump */
static inline double plate_onset(double v, double v_s) { return v_s > 0 ? tanh(fabs(v) / v_s) : 1; }

#endif
