#include "input_value.h"

/* Networks that read delayed inputs and their own past forces, on the grid of their sample time.
 * The state: s since the last instant of the grid, whether it diverged, then values at that instant
 * and before it, the newest first: of each input, of each network's force. Declared before: Mlp. */
typedef struct NarxInput {
  int which; /* as input_value has them */
  int first; /* in the state */
  int size;
  const int* lags;
  int lag_count;
} NarxInput;

typedef struct Narx {
  const NarxInput* inputs;
  int input_count;
  const int* feedback; /* lags of the force */
  int feedback_count;
  const Mlp* members;
  int member_count;
  int forces_at, force_size; /* in the state, per member */
  double sample_time, offset;
} Narx;

static inline double narx_between(double older, double newer, double share) {
  double value = older + (share * (newer - older));
  if (share == 0) {
    value = older;
  } else if (share == 1) {
    value = newer;
  } else {
    /* in between */
  }
  return value;
}

/* The force of one network `share` of a step after the last instant of the grid. */
static inline double narx_evaluate(const Narx* n, int member, const DamperInput* input,
                                   double share, const double* state) {
  double raw[MLP_MOST_WIDTH];
  int k, lag, count = 0;

  /* Past inputs; a lag of 0 is the present one, which needs no grid. */
  for (k = 0; k < n->input_count; ++k) {
    const NarxInput* past = &n->inputs[k];
    for (lag = 0; lag < past->lag_count; ++lag) {
      const int at = past->first + past->lags[lag];
      raw[count] = (past->lags[lag] == 0) ? input_value(input, past->which)
                                          : narx_between(state[at], state[at - 1], share);
      ++count;
    }
  }

  /* Past forces of its own. */
  for (lag = 0; lag < n->feedback_count; ++lag) {
    const int at = n->forces_at + (member * n->force_size) + n->feedback[lag];
    raw[count] = narx_between(state[at], state[at - 1], share);
    ++count;
  }
  return mlp_evaluate(&n->members[member], raw);
}

/* The force within ten scales of its mean; the last one in place of what is no number. */
static inline double narx_held(const Narx* n, int member, double force, double last) {
  const Mlp* m = &n->members[member];
  const double reach = 10 * m->output_scale;
  double value = force;
  if (!(force == force)) {
    value = last;
  } else if (n->feedback_count > 0) {
    value = fmin(fmax(force, m->output_mean - reach), m->output_mean + reach);
  } else {
    /* nothing is fed back */
  }
  return value;
}

static inline void narx_push(double value, double* history, int size) {
  int k;
  for (k = size - 1; k > 0; --k) {
    history[k] = history[k - 1];
  }
  history[0] = value;
}

/* Whether all inputs that are read are numbers. */
static inline int narx_can_read(const Narx* n, const DamperInput* input) {
  int k, can = 1;
  for (k = 0; k < n->input_count; ++k) {
    if (isfinite(input_value(input, n->inputs[k].which)) == 0) {
      can = 0;
    }
  }
  return can;
}

/* Comes to the next instant of the grid, at this input. One that is no number leaves the memory as
 * it was; once diverged, nothing changes. */
static inline void narx_tick(const Narx* n, const DamperInput* input, double* state) {
  int k;
  if ((state[1] == 0) && (narx_can_read(n, input) != 0)) {
    double diverged = 0;
    for (k = 0; k < n->member_count; ++k) {
      double* forces = &state[n->forces_at + (k * n->force_size)];
      const double force = narx_evaluate(n, k, input, 1, state);
      const double kept = narx_held(n, k, force, forces[0]);
      /* A force that had to be held shows that the free run has diverged. */
      if ((n->feedback_count > 0) && (kept != force)) {
        diverged = 1;
      }
      narx_push(kept, forces, n->force_size);
    }
    for (k = 0; k < n->input_count; ++k) {
      const NarxInput* past = &n->inputs[k];
      narx_push(input_value(input, past->which), &state[past->first], past->size);
    }
    state[1] = diverged;
  }
}

static inline void narx_rest(const Narx* n, const DamperInput* input, double* state) {
  const int settling = 300; /* steps */
  DamperInput still = *input;
  int k, j;
  still.velocity = 0;
  state[0] = 0;
  state[1] = 0;

  /* Fill the past with rest, then settle. */
  for (k = 0; k < n->input_count; ++k) {
    for (j = 0; j < n->inputs[k].size; ++j) {
      state[n->inputs[k].first + j] = input_value(&still, n->inputs[k].which);
    }
  }
  for (k = 0; k < n->member_count; ++k) {
    for (j = 0; j < n->force_size; ++j) {
      state[n->forces_at + (k * n->force_size) + j] = n->members[k].output_mean;
    }
  }
  for (k = 0; k < settling; ++k) {
    narx_tick(n, &still, state);
  }
}

static inline void narx_advance(const Narx* n, const DamperInput* from, const DamperInput* to,
                                double dt, double* state) {
  const double slack = 1e-6, most_steps = 10000, step = n->sample_time;
  double pending = state[0], done = 0;

  if (dt > (most_steps * step)) { /* nothing remembers what lay before */
    done = dt - (most_steps * step);
    pending = 0;
  }

  /* From instant to instant of the grid, each with the input that lies there on the straight line
   * between the two that are given. */
  while ((pending + (dt - done)) >= (step * (1 - slack))) {
    done += step - pending;
    if (fabs(dt - done) <= (slack * step)) {
      narx_tick(n, to, state);
    } else {
      DamperInput between;
      between.displacement = narx_between(from->displacement, to->displacement, done / dt);
      between.velocity = narx_between(from->velocity, to->velocity, done / dt);
      between.current = narx_between(from->current, to->current, done / dt);
      narx_tick(n, &between, state);
    }
    pending = 0;
  }

  /* What is left of the way waits for the next call. */
  pending += dt - done;
  state[0] = (pending > (slack * step)) ? pending : 0;
}

static inline int narx_is_now(const Narx* n, const DamperInput* input, const double* state) {
  int k, same = (state[0] == 0) ? 1 : 0;
  for (k = 0; k < n->input_count; ++k) {
    if (state[n->inputs[k].first] != input_value(input, n->inputs[k].which)) {
      same = 0;
    }
  }
  return same;
}

static inline double narx_force(const Narx* n, const DamperInput* input, const double* state) {
  const int known = ((state[1] != 0) || (narx_is_now(n, input, state) != 0)) ? 1 : 0;
  double sum = 0;
  int k;
  for (k = 0; k < n->member_count; ++k) {
    const double last = state[n->forces_at + (k * n->force_size)];
    if (known != 0) {
      sum += last;
    } else {
      sum += narx_held(n, k, narx_evaluate(n, k, input, state[0] / n->sample_time, state), last);
    }
  }
  return (sum / (double)n->member_count) + n->offset;
}
