/* A controller or an inverse as fmu.h sees what is at work in an FMU. It takes a sample where
 * initialization ends and each sample time from there on; in between its commands are held.
 */
#ifndef FMU_BLOCK_H
#define FMU_BLOCK_H
#include <math.h>
#include <string.h>

#include "fmu_between.h"

#define FMU_LONGEST_STEP (1e6 * FMU_SAMPLE_TIME)

typedef struct FmuState {
  damper_model model;
  double commands[FMU_OUTPUTS];
  double age; /* s, of the last sample; by rounding it may be a trifle below 0 */
} FmuState;

/* None of them is a continuous state or a parameter. */
static double* fmu_numbers(FmuState* state) { return state->commands; }

static void fmu_defaults(FmuState* state) { (void)state; }

static void fmu_rest(const double* inputs, FmuState* state) {
  damper_input input;
  fmu_read(inputs, &input);
  damper_reset(&state->model, &input);
  state->model = fmu_sample(state->model, inputs, state->commands);
  state->age = 0;
}

/* All samples between two communication points, that at the second included. Points within a
 * millionth of the sample time of a sample are that sample's: their times are rounded. */
static void fmu_move(const double* from, const double* to, double dt, FmuState* state) {
  const double rounding = 1e-6 * FMU_SAMPLE_TIME;
  const double age = state->age + dt, count = floor((age + rounding) / FMU_SAMPLE_TIME);
  double k;
  for (k = 1; k <= count; ++k) {
    const double left = age - k * FMU_SAMPLE_TIME;
    double inputs[FMU_INPUTS];
    fmu_between(from, to, 1 - left / dt, inputs);
    state->model = fmu_sample(state->model, (left > rounding) ? inputs : to, state->commands);
  }
  state->age = age - count * FMU_SAMPLE_TIME;
}

static void fmu_outputs(const double* inputs, const FmuState* state, double* outputs) {
  (void)inputs;
  memcpy(outputs, state->commands, sizeof state->commands);
}

static void fmu_derivatives(const double* inputs, const FmuState* state, double* derivatives) {
  (void)inputs;
  (void)state;
  (void)derivatives;
}

#endif
