#include "lag.h"

/* States that motion and command drive: first Dahl states w' = rho (v - |v| w), then lags of the
 * velocity, then lags of the command. */
typedef struct HysteresisBank {
  const double* rates; /* rho 1/m, then 1/s */
  int paths, velocities, currents;
} HysteresisBank;

static inline int bank_size(const HysteresisBank* b) {
  return b->paths + b->velocities + b->currents;
}

static inline void bank_rest(const HysteresisBank* b, const DamperInput* input, double* state) {
  const int size = bank_size(b);
  int k;
  for (k = 0; k < size; ++k) {
    state[k] = (k < (b->paths + b->velocities)) ? 0 : input->current;
  }
}

/* Over a way of one direction a Dahl state nears that direction. */
static inline double bank_slide(double w, double rate, double way) {
  const double direction = (way < 0) ? -1 : 1;
  return w + ((w - direction) * expm1(-rate * fabs(way)));
}

static inline void bank_advance(const HysteresisBank* b, const DamperInput* from,
                                const DamperInput* to, double dt, double* state) {
  /* The way of each direction: two where the velocity changes its sign within the step. */
  const double v0 = from->velocity, v1 = to->velocity;
  const int turns = ((v0 * v1) < 0) ? 1 : 0;
  const double turn = (turns != 0) ? (dt * (v0 / (v0 - v1))) : dt;
  const double first = (turns != 0) ? (0.5 * v0 * turn) : (dt * ((0.5 * v0) + (0.5 * v1)));
  const double second = 0.5 * v1 * (dt - turn);
  int k, at = 0;

  /* Dahl states along the way, lags over time: all exact for inputs that are linear in time. */
  for (k = 0; k < b->paths; ++k, ++at) {
    state[at] = bank_slide(state[at], b->rates[at], first);
    if (turns != 0) {
      state[at] = bank_slide(state[at], b->rates[at], second);
    }
  }
  for (k = 0; k < b->velocities; ++k, ++at) {
    state[at] = lag_after(state[at], v0, v1, b->rates[at] * dt);
  }
  for (k = 0; k < b->currents; ++k, ++at) {
    state[at] = lag_after(state[at], from->current, to->current, b->rates[at] * dt);
  }
}

/* The inputs of a network: v, the Dahl states, v less its lags, the lags of the command. */
static inline void bank_read(const HysteresisBank* b, const DamperInput* input, const double* state,
                             double* signals) {
  const int size = bank_size(b);
  int k;
  signals[0] = input->velocity;
  for (k = 0; k < size; ++k) {
    const int is_lag = ((k >= b->paths) && (k < (b->paths + b->velocities))) ? 1 : 0;
    signals[k + 1] = (is_lag != 0) ? (input->velocity - state[k]) : state[k];
  }
}
