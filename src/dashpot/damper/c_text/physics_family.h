/* The force of a damper of a family by plate flow with learnt corrections, as C99 text that the
 * library takes in and the C export ships:
 *
 *   F = g (f_1 + f_2) + F_0,  f_k' = K_k (v - u_k),  f_k = u_k D_k(s_k) / s_k,
 *   s_k^2 = b q + (1 - b) u_k^2 + s_0^2,  q' = (v^2 - q) / t
 *
 * with the seal's force D_1 and the force D_2 of the plate flow at a speed s_k. State: f_1 and f_2,
 * N, and q, m^2/s^2. Geometry, fluid and yield stress are arguments: they may change while it runs.
 */
#ifndef DASHPOT_PHYSICS_FAMILY_H
#define DASHPOT_PHYSICS_FAMILY_H
#include "../../physics/plate_flow.h"

/* Where each learnt number stands. */
typedef enum PhysicsIndex {
  kYieldShare,
  kViscousShare,
  kSealForce,
  kSealGive,
  kStiffness,
  kFieldExponent,
  kFieldGain,
  kFieldHalf,
  kAsymmetry,
  kMemory,
  kOnset,
  kGeometryShare,
  kGapOfAll,
  kLengthOfAll,
  kFluidOfAll,
  kGapOfYield,
  kLengthOfYield,
  kAreaOfYield,
  kFluidOfYield,
  kPhysicsNumbers
} PhysicsIndex;

/* The middle of the dampers and motions of the fit. */
typedef struct PhysicsReference {
  double piston_area, gap_area; /* m^2 */
  double gap, pole_length;      /* m */
  double viscosity;             /* Pa*s */
  double yield_stress;          /* Pa */
  double current;               /* A */
  double force;                 /* N */
  double speed, stroke;         /* m/s, m */
} PhysicsReference;

/* One damper. */
typedef struct PhysicsMember {
  double piston_area, gap_area; /* m^2 */
  double gap, pole_length;      /* m */
  double viscosity;             /* Pa*s */
} PhysicsMember;

/* What one damper at one current comes to. */
typedef struct PhysicsElement {
  double seal, seal_stiffness;         /* N, N/m */
  double yielding, viscous, stiffness; /* N, N s/m, N/m */
  double asymmetry, memory, slow, time;
  double offset;  /* N, of this build */
  double passive; /* N s/m, of gaps without field in the same flow */
} PhysicsElement;

/* A resistance at a speed, N s/m, and its derivative by the speed. */
typedef struct PhysicsResistance {
  double value, slope;
} PhysicsResistance;

/* A friction (viscous 0) or a plate flow: the force it has at a speed, over that speed. */
static inline PhysicsResistance physics_resistance(double yielding, double viscous, double passive,
                                                   double speed) {
  PhysicsResistance r;
  if (!(viscous > 0)) {
    r.value = yielding / speed;
    r.slope = -yielding / (speed * speed);
  } else {
    /* The slope of the pressure p follows from its cubic, p^3 - (N + 3/2 Y) p^2 + Y^3 / 2 = 0. */
    const double newtonian = viscous * speed;
    const double p = plate_bingham_pressure(newtonian, yielding);
    const double slope = p / (3 * p - 2 * (newtonian + 1.5 * yielding));
    r.value = p / speed + passive;
    r.slope = (viscous * slope - p / speed) / speed;
  }
  return r;
}

/* The force f = u R(s) of a resistance that takes the speed u, s^2 = rest + own u^2, where f +
 * spring u = pull, pull >= 0. The left side grows with u, so that a bracketed Newton step ends. */
static inline double physics_balance(double yielding, double viscous, double passive, double pull,
                                     double spring, double rest, double own) {
  PhysicsResistance r = physics_resistance(yielding, viscous, passive, sqrt(rest));
  double low = 0, high = pull / spring;
  double u = pull / (spring + r.value);
  int k;
  if (!(own > 0)) return u * r.value;

  /* A resistance that has yielded leaves the rest of the pull to spring and viscous flow. */
  u = fmax(u, (pull - yielding / sqrt(own)) / (spring + viscous + passive));
  for (k = 0; k < 50; ++k) {
    const double s = sqrt(rest + own * u * u);
    const double tolerance = 1e-9; /* single precision: 1e-5 */
    double excess, next, step;
    r = physics_resistance(yielding, viscous, passive, s);
    excess = u * r.value + spring * u - pull;
    if (excess > 0) {
      high = u;
    } else {
      low = u;
    }
    step = excess / (r.value + u * r.slope * own * u / s + spring);
    next = u - step;

    /* The last step is Newton's own: what it leaves is of the order of its square. A bracket that
     * holds no rounding any more would send it back to the middle. */
    if (fabs(step) <= tolerance * u) {
      u = next;
      break;
    }
    u = next > low && next < high ? next : 0.5 * (low + high);
  }
  r = physics_resistance(yielding, viscous, passive, sqrt(rest + own * u * u));
  return u * r.value;
}

/* n: the learnt numbers; d: how this build differs, logarithms of force, flow and springs, and the
 * offset over the reference force; yield_stress: Pa, at this current. */
static inline PhysicsElement physics_element(const PhysicsReference* r, const double* n,
                                             const double* d, const PhysicsMember* m,
                                             double yield_stress, double current) {
  /* Logarithms over the middle of the family. */
  const double gap = log(m->gap / r->gap), length = log(m->pole_length / r->pole_length);
  const double area = log(m->piston_area / r->piston_area);
  const double width = log(m->gap_area / m->gap / (r->gap_area / r->gap));
  const double fluid = 0.5 * log(m->viscosity / r->viscosity);

  /* What multiplies the whole force, and the flow beside. */
  const double all =
      exp(d[0] + n[kGapOfAll] * gap + n[kLengthOfAll] * length + n[kFluidOfAll] * fluid);
  const double flow = d[1] + n[kGapOfYield] * gap + n[kLengthOfYield] * length +
                      n[kAreaOfYield] * area + n[kFluidOfYield] * fluid;

  /* The field: by the yield stress, and by a share of the current that saturates. */
  const double i = fmin(fabs(current), 1e6 * r->current);
  const double field = pow(yield_stress / r->yield_stress, n[kFieldExponent]) *
                       exp(n[kFieldGain] * i / (i + r->current * exp(n[kFieldHalf])));

  /* Plate flow at the middle of the family, and the power of geometry that the data ask for. */
  const PlateGap middle = {r->pole_length, r->gap_area / r->gap, r->gap};
  const double yielding = r->piston_area * plate_yield_pressure(&middle, r->yield_stress);
  const double viscous =
      r->piston_area * plate_newtonian_pressure(&middle, m->viscosity, r->piston_area);
  const double yield_geometry = length - gap + area;
  const double viscous_geometry = length + 2 * area - width - 3 * gap;

  PhysicsElement e;
  e.seal = all * r->force * exp(n[kSealForce]);
  e.seal_stiffness = e.seal / r->stroke * exp(d[2] - n[kSealGive]);
  e.yielding =
      all * yielding * field * exp(n[kYieldShare] + flow + n[kGeometryShare] * yield_geometry);
  e.viscous = all * viscous * exp(n[kViscousShare] + flow + n[kGeometryShare] * viscous_geometry);
  e.stiffness = all * r->force / r->stroke * exp(d[2] + n[kStiffness]);
  e.asymmetry = n[kAsymmetry];
  e.memory = n[kMemory];
  e.slow = r->speed * exp(n[kOnset]);
  e.time = 2 * 3.141592653589793 * r->stroke / r->speed;
  e.offset = r->force * d[3];
  e.passive = 0;
  return e;
}

/* A stage of a step: the force of a resistance behind its spring, under a pull of either side. */
static inline double physics_side(double yielding, double viscous, double passive, double asymmetry,
                                  double pull, double spring, double rest, double own) {
  const double side = pull < 0 ? -1 : 1, factor = 1 + side * asymmetry;
  return side * physics_balance(yielding * factor, viscous * factor, passive * factor, fabs(pull),
                                spring, rest, own);
}

/* Both stages of a step of a force with its spring. `first`, `second`: the remembered square of
 * the speed, times its share, and the square of the onset, at both. */
static inline double physics_step(double force, double stiffness, double yielding, double viscous,
                                  double passive, double asymmetry, double from, double to,
                                  double dt, double first, double second, double own) {
  const double stage = 1 - sqrt(0.5); /* of the step: where the first stage stands */
  const double spring = stage * dt * stiffness;
  const double middle =
      physics_side(yielding, viscous, passive, asymmetry,
                   force + spring * (from + stage * (to - from)), spring, first, own);
  const double rate = (middle - force) / (stage * dt);
  return physics_side(yielding, viscous, passive, asymmetry,
                      force + (1 - stage) * dt * rate + spring * to, spring, second, own);
}

/* Steps the state from one velocity to the next, by a method of order two that holds for springs of
 * any stiffness (two stages of implicit Runge-Kutta, L-stable). */
static inline void physics_advance(const PhysicsElement* e, double from, double to, double dt,
                                   double* state) {
  if (dt > 0) {
    /* The remembered square of the speed, its drive taken at its mean over the step. */
    const double stage = 1 - sqrt(0.5);
    const double keep = exp(-dt / e->time), before = state[2];
    const double after = before * keep + (from * from + from * to + to * to) / 3 * (1 - keep);
    const double floor_square = e->slow * e->slow;
    const double first = e->memory * (before + stage * (after - before)) + floor_square;
    const double second = e->memory * after + floor_square;
    state[2] = after;
    state[0] = physics_step(state[0], e->seal_stiffness, e->seal, 0, 0, 0, from, to, dt, first,
                            second, 1 - e->memory);
    state[1] = physics_step(state[1], e->stiffness, e->yielding, e->viscous, e->passive,
                            e->asymmetry, from, to, dt, first, second, 1 - e->memory);
  }
}

#endif
