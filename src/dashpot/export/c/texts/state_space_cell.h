#include "held.h"
#include "lag.h"

/* States that velocity and current drive and that act back on themselves:
 *   paths   x' = r (w - |w| x),  lags  y' = r (w - y),  current lags  u' = mu (i - u)
 *   w = v + B phi,  r = rate exp(3 tanh(G phi / 3)),  phi = [1, x, u, tanh(W [x, y, v, u, 1])]
 * Declared before: CELL_MOST_CURRENTS, CELL_MOST_INPUTS, CELL_MOST_FEATURES. */
typedef struct StateSpaceCell {
  int paths, lags, currents, hidden;
  const double* rates; /* of paths, lags, currents */
  double velocity_scale, velocity_low, velocity_high;
  double current_mean, current_scale, current_low, current_high;
  const double* neurons;  /* W, row by row */
  const double* feedback; /* B, then G, row by row */
  double model_step;      /* s; a longer step is divided */
} StateSpaceCell;

static inline int cell_size(const StateSpaceCell* c) { return c->paths + c->lags + c->currents; }

static inline double cell_product(const double* weights, const double* values, int count) {
  double sum = 0;
  int k;
  for (k = 0; k < count; ++k) {
    sum += weights[k] * values[k];
  }
  return sum;
}

/* phi at a standardised velocity and currents; returns how many numbers it has */
static inline int cell_features(const StateSpaceCell* c, double velocity, const double* currents,
                                const double* state, double* phi) {
  const int motions = c->paths + c->lags, stride = motions + 1 + c->currents + 1;
  double inputs[CELL_MOST_INPUTS];
  int k, count = 1;

  /* The neurons' inputs, held within what they saw in training; 1 for their bias. */
  for (k = 0; k < motions; ++k) {
    inputs[k] = state[k];
  }
  inputs[motions] = held(velocity, c->velocity_low, c->velocity_high);
  for (k = 0; k < c->currents; ++k) {
    inputs[motions + 1 + k] = held(currents[k], c->current_low, c->current_high);
  }
  inputs[stride - 1] = 1;

  /* 1, the paths, the currents, the neurons. */
  phi[0] = 1;
  for (k = 0; k < c->paths; ++k) {
    phi[count] = state[k];
    ++count;
  }
  for (k = 0; k < c->currents; ++k) {
    phi[count] = inputs[motions + 1 + k];
    ++count;
  }
  for (k = 0; k < c->hidden; ++k) {
    phi[count] = tanh(cell_product(&c->neurons[k * stride], inputs, stride));
    ++count;
  }
  return count;
}

/* One step of the motion states. */
static inline void cell_step(const StateSpaceCell* c, double h, double velocity,
                             const double* currents, double* state) {
  const double bend = 3; /* rates change by a factor of e^3 at most */
  const int motions = c->paths + c->lags;
  double phi[CELL_MOST_FEATURES];
  const int features = cell_features(c, velocity, currents, state, phi);
  int k;
  for (k = 0; k < motions; ++k) {
    const double w = velocity + cell_product(&c->feedback[k * features], phi, features);
    const double bent =
        tanh(cell_product(&c->feedback[(motions + k) * features], phi, features) / bend);
    const double turn = h * c->rates[k] * exp(bend * bent);

    /* A path nears the direction of w over the way, a lag nears w over time. */
    const double reach = (k < c->paths) ? (turn * fabs(w)) : turn;
    double goal = w;
    if (k < c->paths) {
      goal = (w < 0) ? -1 : 1;
    }
    state[k] += (state[k] - goal) * expm1(-reach);
  }
}

static inline void cell_rest(const StateSpaceCell* c, const DamperInput* input, double* state) {
  const int steps = 32, motions = c->paths + c->lags;
  const double growth = 1.5;
  double h = c->model_step;
  int k;

  /* Lagged currents rest at the present one; motions settle in steps that grow. */
  for (k = 0; k < motions; ++k) {
    state[k] = 0;
  }
  for (k = 0; k < c->currents; ++k) {
    state[motions + k] = (input->current - c->current_mean) / c->current_scale;
  }
  for (k = 0; k < steps; ++k) {
    cell_step(c, h, 0, &state[motions], state);
    h *= growth;
  }
}

static inline void cell_advance(const StateSpaceCell* c, const DamperInput* from,
                                const DamperInput* to, double dt, double* state) {
  const double most_steps = 1000, almost = 1 - 1e-6;
  const double steps = held(ceil((dt / c->model_step) * almost), 1, most_steps), h = dt / steps;
  const double i0 = (from->current - c->current_mean) / c->current_scale;
  const double i1 = (to->current - c->current_mean) / c->current_scale;
  const int motions = c->paths + c->lags, count = (int)steps;
  double middle[CELL_MOST_CURRENTS];
  int s, m;

  /* Equal steps; in each the motions see the mean of the lagged currents before and after it. */
  for (s = 0; s < count; ++s) {
    const double begin = (double)s / steps, end = ((double)s + 1) / steps;
    const double velocity =
        from->velocity + ((to->velocity - from->velocity) * (((double)s + 0.5) / steps));
    for (m = 0; m < c->currents; ++m) {
      double* lagged = &state[motions + m];
      middle[m] = 0.5 * *lagged;
      *lagged = lag_after(*lagged, i0 + ((i1 - i0) * begin), i0 + ((i1 - i0) * end),
                          c->rates[motions + m] * h);
      middle[m] += 0.5 * *lagged;
    }
    cell_step(c, h, velocity / c->velocity_scale, middle, state);
  }
}

/* The inputs of a network: v, the paths, v less its lags, the lags of the command; standardised
 * but for v. */
static inline void cell_read(const StateSpaceCell* c, const DamperInput* input, const double* state,
                             double* signals) {
  const int size = cell_size(c);
  int k;
  signals[0] = input->velocity;
  for (k = 0; k < size; ++k) {
    const int is_lag = ((k >= c->paths) && (k < (c->paths + c->lags))) ? 1 : 0;
    signals[k + 1] = (is_lag != 0) ? ((input->velocity / c->velocity_scale) - state[k]) : state[k];
  }
}
