/* An inverse network in free run on its own past answers. Declared before: MLP_MOST_WIDTH and
 * kMlps, INVERSE_STATES, INVERSE_TAPS and kPlaces of the inputs in the state, the currents kLeast
 * ... kMost that it was taught and kMostChange between two answers. */

/* state: rows of displacement, velocity, wanted force and current, the newest first */
#define INVERSE_SIGNALS 4

static void inverse_rest(const DamperInput* input, double* state) {
  int k;
  for (k = 0; k < INVERSE_STATES; k += INVERSE_SIGNALS) {
    state[k] = input->displacement;
    state[k + 1] = 0;
    state[k + 2] = 0;
    state[k + 3] = held(input->current, kLeast, kMost);
  }
}

/* The network's answer, no further from its last one than it may change. */
static inline double inverse_wanted(const InverseModel* m, const InverseInput* input,
                                    double* state) {
  double raw[MLP_MOST_WIDTH], current;
  int k;
  (void)m;

  /* The past moves by one row, and the present becomes the newest. */
  for (k = INVERSE_STATES - 1; k >= INVERSE_SIGNALS; --k) {
    state[k] = state[k - INVERSE_SIGNALS];
  }
  state[0] = input->displacement;
  state[1] = input->velocity;
  state[2] = input->wanted;

  /* Ask, and hold the answer within the currents that it was taught, and within its change. */
  for (k = 0; k < INVERSE_TAPS; ++k) {
    raw[k] = state[kPlaces[k]];
  }
  current = mlp_evaluate(&kMlps[0], raw);
  if (!(current > kLeast)) { /* nor a number */
    current = kLeast;
  }
  current = fmin(current, kMost);
  state[3] = held(current, state[7] - kMostChange, state[7] + kMostChange);
  return state[3];
}
