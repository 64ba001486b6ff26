/* From a wanted force to a command that stays within the limits, as C99 text that the library takes
 * in and the C export ships. Declared before: InverseInput and InverseModel, of which
 * inverse_least, inverse_most, inverse_lead (how far beyond the wanted change the command goes, so
 * that a coil that lags is there one sample later) and inverse_has_feedback (whether it looks at
 * the measured force) are asked, and inverse_wanted: the current that should flow.
 */

/* The current held within the limits; a current that is no number becomes the least. */
static inline double inverse_within(const InverseModel* m, double current) {
  return (current > inverse_least(m)) ? fmin(current, inverse_most(m)) : inverse_least(m);
}

/* The command. Where an input is not finite, it is the present current; a measured force at which
 * nobody looks may be anything. */
static inline double inverse_command(const InverseModel* m, const InverseInput* input,
                                     double* state) {
  const double held = inverse_within(m, input->current);
  double command = held;
  if ((isfinite(input->wanted) != 0) && (isfinite(input->displacement) != 0) &&
      (isfinite(input->velocity) != 0) && (isfinite(input->current) != 0) &&
      ((inverse_has_feedback(m) == 0) || (isfinite(input->measured) != 0))) {
    const double current = inverse_wanted(m, input, state);
    if (isnan(current) == 0) {
      command = inverse_within(m, held + (inverse_lead(m) * (inverse_within(m, current) - held)));
    }
  }
  return command;
}
