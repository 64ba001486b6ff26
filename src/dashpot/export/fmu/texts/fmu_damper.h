/* A damper as fmu.h sees what is at work in an FMU. */
#ifndef FMU_DAMPER_H
#define FMU_DAMPER_H
#include <math.h>

#include "fmu_between.h"

#define FMU_LONGEST_STEP (1e6 * FMU_SAMPLE_TIME)

typedef struct FmuState {
  double values[FMU_STATE_SIZE];
} FmuState;

static damper_input fmu_input(const double* inputs) {
  damper_input input;
  input.displacement = inputs[0];
  input.velocity = inputs[1];
  input.current = inputs[2];
  return input;
}

static double* fmu_numbers(FmuState* state) { return state->values; }

static void fmu_defaults(FmuState* state) {
#if FMU_PARAMETERS > 0
  damper_defaults(state->values);
#else
  (void)state;
#endif
}

static void fmu_rest(const double* inputs, FmuState* state) {
  const damper_input input = fmu_input(inputs);
  damper_rest(&input, state->values);
}

/* From one communication point to the next, in pieces of the sample time at most. */
static void fmu_move(const double* from, const double* to, double dt, FmuState* state) {
  const double pieces = ceil((dt / FMU_SAMPLE_TIME) * (1.0 - 1e-9));
  const int count = (pieces > 1) ? (int)pieces : 1;
  damper_input begin = fmu_input(from);
  int k;
  for (k = 1; k <= count; ++k) {
    damper_input end = fmu_input(to);
    /* The last piece ends with the inputs that were given, not with a sum of pieces. */
    if (k < count) {
      double inputs[FMU_INPUTS];
      fmu_between(from, to, (double)k / count, inputs);
      end = fmu_input(inputs);
    }
    damper_move(&begin, &end, dt / count, state->values);
    begin = end;
  }
}

static void fmu_outputs(const double* inputs, const FmuState* state, double* outputs) {
  const damper_input input = fmu_input(inputs);
  outputs[0] = damper_force(&input, state->values);
}

static void fmu_derivatives(const double* inputs, const FmuState* state, double* derivatives) {
#if FMU_STATES > 0
  const damper_input input = fmu_input(inputs);
  damper_derivatives(&input, state->values, derivatives);
#else
  (void)inputs;
  (void)state;
  (void)derivatives;
#endif
}

#endif
