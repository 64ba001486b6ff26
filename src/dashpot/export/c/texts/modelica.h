/* What the Modelica package calls: a model in memory of its own, started by its first input. */
#ifndef DAMPER_MODELICA_H
#define DAMPER_MODELICA_H

#include <stdlib.h>

#include "damper.h"

typedef struct damper_object {
  damper_model model;
  int started;
} damper_object;

static inline void* damper_create(void) { return calloc(1, sizeof(damper_object)); }

static inline void damper_destroy(void* object) { free(object); }

/* The force DAMPER_SAMPLE_TIME after the last call. */
static inline double damper_sample(void* object, double s, double v, double i) {
  damper_object* damper = (damper_object*)object;
  damper_input input;
  input.displacement = s;
  input.velocity = v;
  input.current = i;
  if (damper->started) {
    return damper_step(&damper->model, &input);
  }
  damper->started = 1;
  damper_reset(&damper->model, &input);
  return damper_force(&input, damper->model.state);
}

#endif
