/* The force of a damper of a family by plate flow with learnt corrections, as C99 text that the
 * library takes in and the C export ships:
 *
 *   F = g (f_1 + f_2) + F_0,  f_k' = K_k (v - u_k),  f_k = u_k D_k(s_k) / s_k,
 *   s_k^2 = b (p^2 + (v - p)^2) + (1 - b) u_k^2 + s_0^2,  p' = w (v - p)
 *
 * with the seal's force D_1 and the force D_2 of the plate flow at a speed s_k. In a sine at w, p
 * and v - p are a quarter of a cycle apart and equally large, so that their squares sum to the mean
 * square of v at every instant. State: f_1 and f_2, N, and p, m/s. Geometry, fluid and yield stress
 * are arguments: they may change while it runs.
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
  kSealGain,
  kSealHalf,
  kStiffness,
  kFieldExponent,
  kAsymmetry,
  kRoundness,
  kOnset,
  kGapOfAll,
  kLengthOfAll,
  kFluidOfAll,
  kGapOfYield,
  kLengthOfYield,
  kAreaOfYield,
  kFluidOfYield,
  kGapOfSpring,
  kLengthOfSpring,
  kAreaOfSpring,
  kFluidOfSpring,
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
  double asymmetry, roundness, slow;
  double rate;    /* rad/s, of p */
  double offset;  /* N, of this build */
  double passive; /* N s/m, of gaps without field in the same flow */
} PhysicsElement;

/* What sets the speed s of a resistance that takes the speed u: s^2 = rest + own u^2. */
typedef struct PhysicsSpeed {
  double rest, own;  /* m^2/s^2, 1 */
  double slow, root; /* their square roots */
} PhysicsSpeed;

/* The pressure beyond the yielding one that a plate flow has at a newtonian pressure, within 0.4 %:
 * d = (2/3 N Y)^(1/2) + 4/9 N where N is small and N + Y / 2 where it is large, and between them a
 * quotient whose two numbers were chosen for the least error. */
static inline double physics_flowing_about(double newtonian, double yielding) {
  const double w = sqrt(2. / 3 * newtonian * yielding);
  const double quotient = yielding * yielding + 1.42 * yielding * w + 1.32 * w * w;
  return newtonian + (quotient > 0 ? yielding * w * (yielding + 0.66 * w) / quotient : 0);
}

/* A friction's force f = u Y / s where f + spring u = pull, pull >= 0. The left side grows with u
 * and is concave: Newton's steps from below stay below. */
static inline double physics_friction(double yielding, double pull, double spring,
                                      const PhysicsSpeed* at) {
  double u = pull * at->slow / (yielding + spring * at->slow), sliding;
  int k;
  if (!(at->own > 0)) return u * yielding / at->slow;

  /* Below it lie the ends of slow motion and of sliding. */
  sliding = (at->root * pull - yielding) / (at->root * spring);
  if (sliding > u) u = sliding;
  for (k = 0; k < 50; ++k) {
    const double tolerance = 1e-7; /* single precision: 1e-4 */
    const double square = at->rest + at->own * u * u;
    const double resistance = yielding / sqrt(square);
    const double step =
        (pull - u * (resistance + spring)) / (resistance * at->rest / square + spring);
    u += step;
    if (fabs(step) <= tolerance * u) break; /* the next step would move by the square of this */
  }
  return u * yielding / sqrt(at->rest + at->own * u * u);
}

/* The same of a plate flow. Its speed follows from its pressure p = Y + d without a cubic, viscous
 * s = p x^2 (3 - x) / 2 with x = d / p, and u from both: d is where s^2 = rest + own u^2. */
static inline double physics_flow(double yielding, double viscous, double passive, double pull,
                                  double spring, const PhysicsSpeed* at) {
  const double beside = passive + spring;
  double speed = at->slow, d, pressure, low = 0, high = 0;
  int k;

  /* First where the pressure is about that of slow motion, or that which yielding leaves of the
   * pull. */
  if (at->own > 0) {
    const double slowly = plate_gavin_pressure(viscous * speed, yielding);
    const double yielded = (at->root * pull - yielding) / (at->root * (viscous + beside));
    double u = pull * speed / (slowly + beside * speed);
    if (yielded > u) u = yielded;
    speed = sqrt(at->rest + at->own * u * u);
  }
  d = physics_flowing_about(viscous * speed, yielding);

  /* The speed of the pressure grows faster with it than that of the balance, so that a bracketed
   * Newton step ends. */
  for (k = 0; k < 50; ++k) {
    const double tolerance = 1e-7; /* single precision: 1e-4 */
    double x, share, excess, slope, step;
    pressure = yielding + d;
    x = d / pressure;
    speed = pressure * x * x * (1.5 - 0.5 * x) / viscous;
    slope = x * (3 - x * (3 - x)) / viscous;
    share = pull / (pressure + beside * speed); /* u over the speed */
    excess = speed - sqrt(at->rest + at->own * share * share * speed * speed);
    if (excess > 0) {
      high = d;
    } else {
      low = d;
    }
    slope -= at->own * share * share * (slope * pressure - speed) / (pressure + beside * speed);
    step = excess / slope;

    /* The last step is Newton's own: what it leaves is of the order of its square. A bracket that
     * holds no rounding any more would send it back to the middle. */
    if (fabs(step) <= tolerance * d) {
      d -= step;
      break;
    }
    d = d - step > low && (d - step < high || !(high > 0)) ? d - step : 0.5 * (low + high);
  }
  pressure = yielding + d;
  speed = d * d * (d + 1.5 * yielding) / (viscous * pressure * pressure);
  return pull * (pressure + passive * speed) / (pressure + beside * speed);
}

/* How the yielding force and the seal's friction go with the field. */
typedef struct PhysicsField {
  double yield_stress, exponent; /* Pa, 1 */
  double seal_gain, half, most;  /* 1, A, A */
} PhysicsField;

/* n: the learnt numbers. */
static inline PhysicsField physics_field(const PhysicsReference* r, const double* n) {
  PhysicsField f;
  f.yield_stress = r->yield_stress;
  f.exponent = n[kFieldExponent];
  f.seal_gain = n[kSealGain];
  f.half = r->current * exp(n[kSealHalf]);
  f.most = 1e6 * r->current;
  return f;
}

/* What the field makes of a damper: its yielding force goes with a power of the yield stress, Pa,
 * at this current, and the seal's friction with a share of the current that saturates. */
static inline void physics_apply_field(const PhysicsField* f, double yield_stress, double current,
                                       PhysicsElement* element) {
  const double i = fmin(fabs(current), f->most);
  element->yielding *= pow(yield_stress / f->yield_stress, f->exponent);
  element->seal *= exp(f->seal_gain * i / (i + f->half));
}

/* One damper before physics_apply_field(), which leaves its springs as they are. n: the learnt
 * numbers; d: how this build differs, logarithms of force, flow and springs, and the offset
 * over the reference force. */
static inline PhysicsElement physics_drawn(const PhysicsReference* r, const double* n,
                                           const double* d, const PhysicsMember* m) {
  /* Logarithms over the middle of the family. */
  const double gap = log(m->gap / r->gap), length = log(m->pole_length / r->pole_length);
  const double area = log(m->piston_area / r->piston_area);
  const double fluid = 0.5 * log(m->viscosity / r->viscosity);

  /* What multiplies the whole force, and beside that the flow and its spring. */
  const double all =
      exp(d[0] + n[kGapOfAll] * gap + n[kLengthOfAll] * length + n[kFluidOfAll] * fluid);
  const double flow = d[1] + n[kGapOfYield] * gap + n[kLengthOfYield] * length +
                      n[kAreaOfYield] * area + n[kFluidOfYield] * fluid;
  const double spring = d[2] + n[kGapOfSpring] * gap + n[kLengthOfSpring] * length +
                        n[kAreaOfSpring] * area + n[kFluidOfSpring] * fluid;

  /* The plate flow of its own gap, at the family's yield stress. */
  const PlateGap drawn = {m->pole_length, m->gap_area / m->gap, m->gap};
  const double yielding = m->piston_area * plate_yield_pressure(&drawn, r->yield_stress);
  const double viscous =
      m->piston_area * plate_newtonian_pressure(&drawn, m->viscosity, m->piston_area);

  PhysicsElement e;
  e.seal = all * r->force * exp(n[kSealForce]);
  e.seal_stiffness = e.seal / r->stroke * exp(d[2] - n[kSealGive]);
  e.yielding = all * yielding * exp(n[kYieldShare] + flow);
  e.viscous = all * viscous * exp(n[kViscousShare] + flow);
  e.stiffness = all * r->force / r->stroke * exp(spring + n[kStiffness]);
  e.asymmetry = n[kAsymmetry];
  e.roundness = n[kRoundness];
  e.slow = r->speed * exp(n[kOnset]);
  e.rate = r->speed / r->stroke;
  e.offset = r->force * d[3];
  e.passive = 0;
  return e;
}

/* The same at a current, A, with its yield stress, Pa. */
static inline PhysicsElement physics_element(const PhysicsReference* r, const double* n,
                                             const double* d, const PhysicsMember* m,
                                             double yield_stress, double current) {
  const PhysicsField field = physics_field(r, n);
  PhysicsElement e = physics_drawn(r, n, d, m);
  physics_apply_field(&field, yield_stress, current, &e);
  return e;
}

/* A stage of a step: the force of a resistance, a friction where nothing is viscous, behind its
 * spring, under a pull of either side. */
static inline double physics_side(double yielding, double viscous, double passive, double asymmetry,
                                  double pull, double spring, const PhysicsSpeed* at) {
  const double side = pull < 0 ? -1 : 1, factor = 1 + side * asymmetry;
  return side * (viscous > 0 ? physics_flow(yielding * factor, viscous * factor, passive * factor,
                                            fabs(pull), spring, at)
                             : physics_friction(yielding * factor, fabs(pull), spring, at));
}

/* Both stages of a step of a force with its spring. */
static inline double physics_step(double force, double stiffness, double yielding, double viscous,
                                  double passive, double asymmetry, double from, double to,
                                  double dt, const PhysicsSpeed* first,
                                  const PhysicsSpeed* second) {
  const double stage = 1 - sqrt(0.5); /* of the step: where the first stage stands */
  const double spring = stage * dt * stiffness;
  const double middle = physics_side(yielding, viscous, passive, asymmetry,
                                     force + spring * (from + stage * (to - from)), spring, first);
  const double rate = (middle - force) / (stage * dt);
  return physics_side(yielding, viscous, passive, asymmetry,
                      force + (1 - stage) * dt * rate + spring * to, spring, second);
}

/* Of a velocity and the one that follows it. */
static inline PhysicsSpeed physics_speed(const PhysicsElement* e, double velocity,
                                         double follower) {
  const double ahead = velocity - follower;
  PhysicsSpeed at;
  at.rest = e->roundness * (follower * follower + ahead * ahead) + e->slow * e->slow;
  at.own = 1 - e->roundness;
  at.slow = sqrt(at.rest);
  at.root = sqrt(at.own);
  return at;
}

/* Steps the state from one velocity to the next, by a method of order two that holds for springs of
 * any stiffness (two stages of implicit Runge-Kutta, L-stable). */
static inline void physics_advance(const PhysicsElement* e, double from, double to, double dt,
                                   double* state) {
  if (dt > 0) {
    /* What follows the velocity takes it at its mean over the step. */
    const double stage = 1 - sqrt(0.5);
    const double keep = exp(-e->rate * dt), before = state[2];
    const double after = before * keep + 0.5 * (from + to) * (1 - keep);
    const PhysicsSpeed first =
        physics_speed(e, from + stage * (to - from), before + stage * (after - before));
    const PhysicsSpeed second = physics_speed(e, to, after);
    state[2] = after;
    state[0] =
        physics_step(state[0], e->seal_stiffness, e->seal, 0, 0, 0, from, to, dt, &first, &second);
    state[1] = physics_step(state[1], e->stiffness, e->yielding, e->viscous, e->passive,
                            e->asymmetry, from, to, dt, &first, &second);
  }
}

#endif
