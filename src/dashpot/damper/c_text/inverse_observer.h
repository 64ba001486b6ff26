/* A free run of a model beside the damper, as C99 text that the library takes in and the C export
 * ships. Declared before: DamperInput, InverseInput and Observer, of which are asked
 * observed_states (numbers in the model's state), observed_rest, observed_advance and
 * observed_force (of the model, without the lag of its coil), observer_step (s between two
 * commands), observer_lags (whether the coil does) and observer_horizon (steps ahead at which
 * currents are judged).
 *
 * Its state: the model's own, room to try, and the last displacement, velocity and current.
 */

/* Keeps the input until the next step, which starts from it. */
static inline void observer_remember(const Observer* m, const DamperInput* input, double* state) {
  double* last = &state[2 * observed_states(m)];
  last[0] = input->displacement;
  last[1] = input->velocity;
  last[2] = input->current;
}

/* State after a long rest at this input. */
static inline void observer_rest(const Observer* m, const DamperInput* input, double* state) {
  observed_rest(m, input, state);
  observer_remember(m, input, state);
}

/* Comes to the present from the last call on. A state that is not finite starts anew, from rest. */
static inline void observer_follow(const Observer* m, const InverseInput* input, double* state) {
  const double* last = &state[2 * observed_states(m)];
  int finite = 1, k;
  DamperInput before, now;

  /* The step: from the last input that was remembered to the present one. */
  now.displacement = input->displacement;
  now.velocity = input->velocity;
  now.current = input->current;
  before.displacement = last[0];
  before.velocity = last[1];
  /* A coil without lag jumped to its present current at the last command. */
  before.current = (observer_lags(m) != 0) ? last[2] : input->current;

  observed_advance(m, &before, &now, observer_step(m), state);
  observer_remember(m, &now, state);

  /* A model that diverged starts anew. */
  for (k = 0; k < observed_states(m); ++k) {
    if (isfinite(state[k]) == 0) {
      finite = 0;
    }
  }
  if (finite == 0) {
    observed_rest(m, &now, state);
  }
}

/* The force at this current and the present motion; at the end of the horizon when there is one. */
static inline double observer_force(const Observer* m, double current, const InverseInput* input,
                                    double* state) {
  double* trial = state;
  DamperInput from;
  int k;
  from.displacement = input->displacement;
  from.velocity = input->velocity;
  from.current = current;

  /* A horizon is tried on a copy of the model's state. */
  if (observer_horizon(m) > 0) {
    trial = &state[observed_states(m)];
    for (k = 0; k < observed_states(m); ++k) {
      trial[k] = state[k];
    }
  }

  /* Over it the motion goes on at its present velocity, with the current held. */
  for (k = 0; k < observer_horizon(m); ++k) {
    DamperInput to = from;
    to.displacement += to.velocity * observer_step(m);
    observed_advance(m, &from, &to, observer_step(m), trial);
    from = to;
  }
  return observed_force(m, &from, trial);
}
