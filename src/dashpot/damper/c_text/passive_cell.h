#include "held.h"
#include "lag.h"

/* A damper that cannot generate energy, whatever its networks say, as C99 text that the library
 * takes in and the C export ships. Springs of fixed stiffness k hang on levers A(q) that the drive
 * q moves, and resistances r drain them. With v, x, q and the forces s and f standardised:
 *
 *   s' = k (A v - r s),   r = exp(g_a) + |A v| exp(g_b)
 *   A  = P + Q a,         P, Q >= 0
 *   a  = i (1 - exp(-q / i)), q' = (drive - q) rate
 *   f  = sum A s + c v + U'(x) + m (v - w) n,   w' = n (v - w)
 *
 * The gates g and the viscous term c >= 0 are small networks of v, x, q and of memories u that may
 * be anything; g reads s, too:
 *
 *   [h, p] = tanh(W [v, x, d, u, s, 1]),  g = G [h, 1, a],  u' = rate (p - u)
 *   z = C [tanh(V [v, x, d, u, 1]), 1, a],  c = (z + sqrt(z^2 + 1)) / 2
 *
 * U is convex: x^2 and an exponential to each side, which go on straight outside of the data.
 * Declared before: PASSIVE_MOST_INPUTS, PASSIVE_MOST_NEURONS, PASSIVE_MOST_SPRINGS. */
typedef struct PassiveCell {
  int springs, memories, neurons, viscous_neurons;
  int lags;                 /* 1: the drive acts through a lag, which is a state */
  int inert;                /* 1: with inertia, whose speed w is a state */
  double displacement_mean; /* m */
  double displacement_gain; /* 1/m; 0: displacement is not read */
  double displacement_low, displacement_high;
  double velocity_gain;               /* s/m */
  double velocity_low, velocity_high; /* what the networks see is held within */
  double drive_gain;                  /* 1/A or 1/V */
  double drive_low, drive_high;
  double drive_fade;             /* beyond them the networks' reading of q ends so soon; 0: never */
  double force_scale;            /* N */
  double drive_rate, saturation; /* 1/s; i above */
  double inertia, inertia_rate;  /* m n; n, 1/s */
  const double* potential;       /* stiffness; size and slope to each side */
  const double* stiffness;       /* k, 1/s */
  const double* levers;          /* P, then Q */
  const double* memory_rates;    /* 1/s */
  const double* weights;         /* W, row by row: neurons, then memories */
  const double* gates;           /* G, row by row: g_a of all springs, then g_b */
  const double* viscous_weights; /* V, row by row */
  const double* viscous;         /* C */
  double model_step;             /* s; a longer step is divided */
} PassiveCell;

/* Where the parts of the state stand: q, u, s, w. */
static inline int passive_memories_at(const PassiveCell* c) { return c->lags; }
static inline int passive_springs_at(const PassiveCell* c) { return c->lags + c->memories; }
static inline int passive_size(const PassiveCell* c) {
  return c->lags + c->memories + c->springs + c->inert;
}

static inline double passive_displacement(const PassiveCell* c, const DamperInput* input) {
  return (input->displacement - c->displacement_mean) * c->displacement_gain;
}

/* The share a: 0 without drive, rising as the drive at first, never to the saturation i. */
static inline double passive_share(const PassiveCell* c, double drive) {
  return -c->saturation * expm1(-fmax(drive, 0) / c->saturation);
}

static inline double passive_lever(const PassiveCell* c, int k, double share) {
  return c->levers[k] + (c->levers[c->springs + k] * share);
}

/* What both networks see, held within the data: v, x, d (q about its middle), the memories. Beyond
 * the data the drive moves levers and shares alone: what networks have read of it there fades.
 * Returns how many. */
static inline int passive_see(const PassiveCell* c, double velocity, double displacement,
                              double drive, const double* memories, double* inputs) {
  const double within = held(drive, c->drive_low, c->drive_high);
  int k;
  inputs[0] = held(velocity, c->velocity_low, c->velocity_high);
  inputs[1] = held(displacement, c->displacement_low, c->displacement_high);
  inputs[2] = within - (0.5 * (c->drive_low + c->drive_high));
  if (c->drive_fade > 0) {
    inputs[2] *= fmax(1 - (fabs(drive - within) / c->drive_fade), 0);
  }
  for (k = 0; k < c->memories; ++k) {
    inputs[3 + k] = memories[k];
  }
  return 3 + c->memories;
}

/* A network's sum: a weight per input, then its bias. */
static inline double passive_sum(const double* weights, const double* inputs, int count) {
  double sum = weights[count];
  int k;
  for (k = 0; k < count; ++k) {
    sum += weights[k] * inputs[k];
  }
  return sum;
}

/* The resistances of every spring by time (1/s once multiplied by k) and by way, and what the
 * memories near. */
static inline void passive_gates(const PassiveCell* c, double velocity, double displacement,
                                 double drive, const double* state, double* by_time, double* by_way,
                                 double* goals) {
  const double share = passive_share(c, drive), least = -12, most = 8;
  const int stride = c->neurons + 2;
  double inputs[PASSIVE_MOST_INPUTS], hidden[PASSIVE_MOST_NEURONS];
  int count, k;

  count = passive_see(c, velocity, displacement, drive, &state[passive_memories_at(c)], inputs);
  for (k = 0; k < c->springs; ++k) {
    inputs[count + k] = state[passive_springs_at(c) + k];
  }
  count += c->springs;
  for (k = 0; k < c->neurons; ++k) {
    hidden[k] = tanh(passive_sum(&c->weights[k * (count + 1)], inputs, count));
  }
  for (k = 0; k < c->memories; ++k) {
    goals[k] = tanh(passive_sum(&c->weights[(c->neurons + k) * (count + 1)], inputs, count));
  }
  for (k = 0; k < c->springs; ++k) {
    const double* a = &c->gates[k * stride];
    const double* b = &c->gates[(c->springs + k) * stride];
    by_time[k] =
        exp(held(passive_sum(a, hidden, c->neurons) + (a[stride - 1] * share), least, most));
    by_way[k] =
        exp(held(passive_sum(b, hidden, c->neurons) + (b[stride - 1] * share), least, most));
  }
}

/* One step at gates that stand still: springs and memories are exact then, so the energy that
 * springs take in is never less than what they store. */
static inline void passive_step(const PassiveCell* c, double h, double velocity,
                                double displacement, double drive, double* state) {
  const double share = passive_share(c, drive);
  double by_time[PASSIVE_MOST_SPRINGS], by_way[PASSIVE_MOST_SPRINGS], goals[PASSIVE_MOST_INPUTS];
  double* memories = &state[passive_memories_at(c)];
  double* springs = &state[passive_springs_at(c)];
  int k;

  passive_gates(c, velocity, displacement, drive, state, by_time, by_way, goals);
  for (k = 0; k < c->memories; ++k) {
    memories[k] += (memories[k] - goals[k]) * expm1(-c->memory_rates[k] * h);
  }
  for (k = 0; k < c->springs; ++k) {
    const double speed = passive_lever(c, k, share) * velocity;
    const double resistance = by_time[k] + (fabs(speed) * by_way[k]);
    const double goal = speed / resistance;
    springs[k] += (springs[k] - goal) * expm1(-h * c->stiffness[k] * resistance);
  }
  if (c->inert != 0) {
    double* follower = &springs[c->springs];
    *follower += (*follower - velocity) * expm1(-c->inertia_rate * h);
  }
}

/* The standardised drive at this instant, behind its lag. */
static inline double passive_drive(const PassiveCell* c, const DamperInput* input,
                                   const double* state) {
  return (c->lags != 0) ? state[0] : (input->current * c->drive_gain);
}

static inline void passive_rest(const PassiveCell* c, const DamperInput* input, double* state) {
  const int steps = 32, size = passive_size(c);
  const double growth = 1.5, displacement = passive_displacement(c, input);
  double h = c->model_step;
  int k;

  /* Springs without force; memories settle in steps that grow. */
  for (k = 0; k < size; ++k) {
    state[k] = 0;
  }
  if (c->lags != 0) {
    state[0] = input->current * c->drive_gain;
  }
  if (c->memories > 0) {
    for (k = 0; k < steps; ++k) {
      passive_step(c, h, 0, displacement, passive_drive(c, input, state), state);
      h *= growth;
    }
  }
}

static inline void passive_advance(const PassiveCell* c, const DamperInput* from,
                                   const DamperInput* to, double dt, double* state) {
  const double most_steps = 1000, almost = 1 - 1e-6;
  const double steps = held(ceil((dt / c->model_step) * almost), 1, most_steps), h = dt / steps;
  const double x0 = passive_displacement(c, from), x1 = passive_displacement(c, to);
  const double v0 = from->velocity * c->velocity_gain, v1 = to->velocity * c->velocity_gain;
  const double i0 = from->current * c->drive_gain, i1 = to->current * c->drive_gain;
  const int count = (int)steps;
  int s;

  /* Equal steps, each at the motion and the drive of its middle. */
  for (s = 0; s < count; ++s) {
    const double begin = (double)s / steps, end = ((double)s + 1) / steps;
    const double middle = ((double)s + 0.5) / steps;
    double drive = i0 + ((i1 - i0) * middle);
    if (c->lags != 0) {
      drive = 0.5 * state[0];
      state[0] =
          lag_after(state[0], i0 + ((i1 - i0) * begin), i0 + ((i1 - i0) * end), c->drive_rate * h);
      drive += 0.5 * state[0];
    }
    passive_step(c, h, v0 + ((v1 - v0) * middle), x0 + ((x1 - x0) * middle), drive, state);
  }
}

/* The viscous term c, standardised. */
static inline double passive_viscosity(const PassiveCell* c, double velocity, double displacement,
                                       double drive, const double* state) {
  const int neurons = c->viscous_neurons;
  double inputs[PASSIVE_MOST_INPUTS], hidden[PASSIVE_MOST_NEURONS], z;
  const int count =
      passive_see(c, velocity, displacement, drive, &state[passive_memories_at(c)], inputs);
  int k;
  for (k = 0; k < neurons; ++k) {
    hidden[k] = tanh(passive_sum(&c->viscous_weights[k * (count + 1)], inputs, count));
  }
  z = passive_sum(c->viscous, hidden, neurons) +
      (c->viscous[neurons + 1] * passive_share(c, drive));
  return 0.5 * (z + sqrt((z * z) + 1));
}

/* The force of the potential, which rises with x everywhere. */
static inline double passive_potential(const PassiveCell* c, double displacement) {
  const double* p = c->potential;
  const double within = held(displacement, c->displacement_low, c->displacement_high);
  const double more = p[1] * exp(p[2] * within), less = p[3] * exp(-p[4] * within);
  return ((p[0] * displacement) + more - less) +
         (((p[2] * more) + (p[4] * less)) * (displacement - within));
}

static inline double passive_force(const PassiveCell* c, const DamperInput* input,
                                   const double* state) {
  const double velocity = input->velocity * c->velocity_gain;
  const double displacement = passive_displacement(c, input);
  const double drive = passive_drive(c, input, state), share = passive_share(c, drive);
  const double* springs = &state[passive_springs_at(c)];
  double force = passive_viscosity(c, velocity, displacement, drive, state) * velocity;
  int k;
  force += passive_potential(c, displacement);
  if (c->inert != 0) {
    force += c->inertia * (velocity - springs[c->springs]);
  }
  for (k = 0; k < c->springs; ++k) {
    force += passive_lever(c, k, share) * springs[k];
  }
  return force * c->force_scale;
}
