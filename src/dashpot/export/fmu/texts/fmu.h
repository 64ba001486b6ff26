/* What the FMUs of FMI 2 and FMI 3 share: variables, the state as one block of plain data, and what
 * may be asked of it when. fmu_model.h says what is at work here, a damper, a controller or an
 * inverse.
 *
 * Co-simulation: between communication points the inputs are linear, as between the samples of a
 * record. A step is computed when its end is asked for: with the inputs that were set since, or,
 * when none were, those of its start held. So whoever sets the inputs of a communication point
 * before reading the outputs gets the outputs of that point.
 */
#ifndef FMU_H
#define FMU_H

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmu_model.h"

/* Value references. */
enum {
  FMU_TIME = 0,
  FMU_INPUT = 1,
  FMU_OUTPUT = FMU_INPUT + FMU_INPUTS,
  FMU_STATE = FMU_OUTPUT + FMU_OUTPUTS,
  FMU_DERIVATIVE = FMU_STATE + FMU_STATES,
  FMU_PARAMETER = FMU_DERIVATIVE + FMU_STATES,
  FMU_VARIABLES = FMU_PARAMETER + FMU_PARAMETERS
};

/* As FMI 2 and FMI 3 number them. */
enum { FMU_OK = 0, FMU_DISCARD = 2, FMU_ERROR = 3 };

enum {
  FMU_INSTANTIATED = 1,
  FMU_INITIALIZATION = 2,
  FMU_EVENT = 4,
  FMU_CONTINUOUS = 8,
  FMU_STEP = 16,
  FMU_TERMINATED = 32,
  FMU_ANY = 63
};

/* All that changes. */
typedef struct FmuData {
  char token[sizeof FMU_TOKEN];
  int exchanges; /* model exchange; 0: co-simulation */
  int mode;
  int stale;                /* `state` waits to be computed */
  double time, stop;        /* s */
  double since;             /* s, from `past` to `time` */
  double from[FMU_INPUTS];  /* at `past` */
  double input[FMU_INPUTS]; /* at `time` */
  FmuState past;            /* at the last but one communication point */
  FmuState state;           /* at `time` */
} FmuData;

typedef struct FmuInstance {
  FmuData data;
  void (*report)(const struct FmuInstance* instance, const char* message);
  void* (*allocate)(size_t count, size_t size);
  void (*release)(void* block);
} FmuInstance;

static int fmu_fail(const FmuInstance* f, const char* function, const char* format, ...) {
  char message[400];
  const int used = snprintf(message, sizeof message, "%s: ", function);
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(message + used, sizeof message - (size_t)used, format, arguments);
  va_end(arguments);
  f->report(f, message);
  return FMU_ERROR;
}

static const char* fmu_mode_name(int mode) {
  switch (mode) {
    /* as they are met in a simulation */
    case FMU_INSTANTIATED:
      return "before initialization mode";
    case FMU_INITIALIZATION:
      return "in initialization mode";
    case FMU_EVENT:
      return "in event mode";
    case FMU_CONTINUOUS:
      return "in continuous-time mode";
    case FMU_STEP:
      return "in co-simulation";
    default:
      return "after termination";
  }
}

/* Whether there is an instance and it is in one of these modes. */
static int fmu_may(const FmuInstance* f, const char* function, int modes) {
  if (f == NULL) {
    return 0;
  }
  if ((f->data.mode & modes) == 0) {
    fmu_fail(f, function, "must not be called %s", fmu_mode_name(f->data.mode));
    return 0;
  }
  return 1;
}

static void fmu_take_parameters(FmuState* from, FmuState* to) {
  int k;
  for (k = FMU_FIRST_PARAMETER; k < FMU_FIRST_PARAMETER + FMU_PARAMETERS; ++k) {
    fmu_numbers(to)[k] = fmu_numbers(from)[k];
  }
}

static void fmu_update(FmuData* d) {
  if (d->stale == 0) {
    return;
  }
  d->stale = 0;
  if ((d->mode & (FMU_INSTANTIATED | FMU_INITIALIZATION)) != 0) {
    fmu_rest(d->input, &d->state);
  } else if (d->since > 0) {
    /* The step has the parameters of its start; those that were set since hold from its end on. */
    FmuState moved = d->past;
    fmu_move(d->from, d->input, d->since, &moved);
    fmu_take_parameters(&d->state, &moved);
    d->state = moved;
  }
}

/* Keeps what has been computed, whatever is set from now on. */
static void fmu_settle(FmuData* d) {
  fmu_update(d);
  d->past = d->state;
  memcpy(d->from, d->input, sizeof d->from);
  d->since = 0;
}

static void fmu_start(FmuInstance* f, int exchanges) {
  memset(&f->data, 0, sizeof f->data);
  memcpy(f->data.token, FMU_TOKEN, sizeof FMU_TOKEN);
  f->data.exchanges = exchanges;
  f->data.mode = FMU_INSTANTIATED;
  f->data.stop = HUGE_VAL;
  f->data.stale = 1;
  fmu_defaults(&f->data.state);
}

/* The place of a variable from which others follow; NULL for the others. */
static double* fmu_place(FmuData* d, unsigned reference) {
  if (reference == FMU_TIME) {
    return &d->time;
  }
  if (reference < FMU_OUTPUT) {
    return &d->input[reference - FMU_INPUT];
  }
  if (reference >= FMU_PARAMETER) {
    return &fmu_numbers(&d->state)[FMU_FIRST_PARAMETER + (reference - FMU_PARAMETER)];
  }
  if ((reference >= FMU_STATE) && (reference < FMU_DERIVATIVE)) {
    return &fmu_numbers(&d->state)[reference - FMU_STATE];
  }
  return NULL;
}

static double fmu_value(FmuData* d, unsigned reference) {
  const double* place = fmu_place(d, reference);
  double outputs[FMU_OUTPUTS], derivatives[FMU_STATES + 1] = {0};
  fmu_update(d);
  if (place != NULL) {
    return *place;
  }
  if (reference < FMU_STATE) {
    fmu_outputs(d->input, &d->state, outputs);
    return outputs[reference - FMU_OUTPUT];
  }
  fmu_derivatives(d->input, &d->state, derivatives);
  return derivatives[reference - FMU_DERIVATIVE];
}

/* Whether an array can be read or written and has the size that it must have. */
static int fmu_takes(const FmuInstance* f, const char* function, const void* array, size_t size,
                     size_t expected) {
  if (size != expected) {
    fmu_fail(f, function, "got %lu values instead of %lu", (unsigned long)size,
             (unsigned long)expected);
    return 0;
  }
  if ((array == NULL) && (size > 0)) {
    fmu_fail(f, function, "got a null pointer");
    return 0;
  }
  return 1;
}

static int fmu_all_finite(const FmuInstance* f, const char* function, const double* values,
                          size_t count) {
  size_t k;
  for (k = 0; k < count; ++k) {
    if (!isfinite(values[k])) {
      fmu_fail(f, function, "value %lu is not a finite number", (unsigned long)k);
      return 0;
    }
  }
  return 1;
}

static int fmu_get(FmuInstance* f, const char* function, const unsigned* references, size_t count,
                   double* values) {
  size_t k;
  if (!fmu_may(f, function, FMU_ANY) || !fmu_takes(f, function, references, count, count) ||
      !fmu_takes(f, function, values, count, count)) {
    return FMU_ERROR;
  }

  /* A reference that is wrong ends the call; what was read before stays read. */
  for (k = 0; k < count; ++k) {
    if (references[k] >= FMU_VARIABLES) {
      return fmu_fail(f, function, "there is no variable with value reference %u", references[k]);
    }
    values[k] = fmu_value(&f->data, references[k]);
    if (!isfinite(values[k])) {
      return fmu_fail(f, function, "%s is not a finite number", fmu_names[references[k]]);
    }
  }
  return FMU_OK;
}

static int fmu_check_new_value(const FmuInstance* f, const char* function, unsigned reference,
                               double value) {
  if (reference >= FMU_VARIABLES) {
    return fmu_fail(f, function, "there is no variable with value reference %u", reference);
  }
  if ((reference == FMU_TIME) || ((reference >= FMU_OUTPUT) && (reference < FMU_PARAMETER))) {
    return fmu_fail(f, function, "%s is neither an input nor a parameter", fmu_names[reference]);
  }

  /* The value itself; parameters have limits. */
  if (!isfinite(value)) {
    return fmu_fail(f, function, "the value for %s is not a finite number", fmu_names[reference]);
  }
  if (reference >= FMU_PARAMETER) {
    const double* range = fmu_ranges[reference - FMU_PARAMETER];
    if (f->data.mode == FMU_CONTINUOUS) {
      return fmu_fail(f, function, "parameters change in event mode only");
    }
    if ((value < range[0]) || (value > range[1])) {
      return fmu_fail(f, function, "%s = %g is outside %g ... %g", fmu_names[reference], value,
                      range[0], range[1]);
    }
  }
  return FMU_OK;
}

/* Sets all of them or, on an error, none. */
static int fmu_set(FmuInstance* f, const char* function, const unsigned* references, size_t count,
                   const double* values) {
  FmuData* d;
  size_t k;
  if (!fmu_may(f, function, FMU_ANY & ~FMU_TERMINATED) ||
      !fmu_takes(f, function, references, count, count) ||
      !fmu_takes(f, function, values, count, count)) {
    return FMU_ERROR;
  }

  /* Look at all before any is set. */
  d = &f->data;
  for (k = 0; k < count; ++k) {
    if (fmu_check_new_value(f, function, references[k], values[k]) != FMU_OK) {
      return FMU_ERROR;
    }
  }

  /* Set them; what follows from them is computed when it is asked for. */
  for (k = 0; k < count; ++k) {
    *fmu_place(d, references[k]) = values[k];
  }
  if ((count > 0) && ((d->mode & (FMU_INSTANTIATED | FMU_INITIALIZATION | FMU_STEP)) != 0)) {
    d->stale = 1;
  }
  return FMU_OK;
}

#endif
