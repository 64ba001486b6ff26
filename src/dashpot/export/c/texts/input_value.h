/* One of the inputs: 0 displacement, 1 velocity, 2 current. */
static inline double input_value(const DamperInput* input, int which) {
  double value = input->current;
  if (which == 0) {
    value = input->displacement;
  } else if (which == 1) {
    value = input->velocity;
  } else {
    /* the current */
  }
  return value;
}
