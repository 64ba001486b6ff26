/* What the FMUs of FMI 2 and FMI 3 share: a damper's variables, its state as one block of plain data, and
 * what may be asked of it when. fmu_model.h says which damper it is.
 *
 * Co-simulation: between communication points the inputs are linear, as between the samples of a record. A
 * step is computed when its end is asked for: with the inputs that were set since, or, when none were, those
 * of its start held. So whoever sets the inputs of a communication point before reading the force gets the
 * force of that point.
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
  FMU_DISPLACEMENT = 1,
  FMU_VELOCITY = 2,
  FMU_CURRENT = 3,
  FMU_FORCE = 4,
  FMU_STATE = 5,
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
  int stale;                    /* `state` waits to be computed */
  double time, stop;            /* s */
  double since;                 /* s, from `past` to `time` */
  FmuInput from, input;         /* at `past`, at `time` */
  double past[FMU_STATE_SIZE];  /* the state at the last but one communication point */
  double state[FMU_STATE_SIZE]; /* at `time` */
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

/* From one communication point to the next, in pieces of the sample time at most. */
static void fmu_bring(const FmuInput* from, const FmuInput* to, double dt, double* state) {
  const double most_pieces = 1e6, pieces = ceil((dt / FMU_SAMPLE_TIME) * (1.0 - 1e-9));
  const int count = (pieces > 1) ? (int)fmin(pieces, most_pieces) : 1;
  FmuInput begin = *from;
  int k;
  for (k = 1; k <= count; ++k) {
    const double share = (double)k / count;
    FmuInput end = *to;
    if (k < count) {
      end.displacement = from->displacement + share * (to->displacement - from->displacement);
      end.velocity = from->velocity + share * (to->velocity - from->velocity);
      end.current = from->current + share * (to->current - from->current);
    }
    fmu_move(&begin, &end, dt / count, state);
    begin = end;
  }
}

static void fmu_update(FmuData* d) {
  if (d->stale == 0) {
    return;
  }
  d->stale = 0;
  if ((d->mode & (FMU_INSTANTIATED | FMU_INITIALIZATION)) != 0) {
    fmu_rest(&d->input, d->state);
  } else if (d->since > 0) {
    memcpy(d->state, d->past, sizeof d->state);
    fmu_bring(&d->from, &d->input, d->since, d->state);
  }
}

/* What has been computed stays, whatever is set from now on. */
static void fmu_settle(FmuData* d) {
  fmu_update(d);
  memcpy(d->past, d->state, sizeof d->past);
  d->from = d->input;
  d->since = 0;
}

static void fmu_start(FmuInstance* f, int exchanges) {
  memset(&f->data, 0, sizeof f->data);
  memcpy(f->data.token, FMU_TOKEN, sizeof FMU_TOKEN);
  f->data.exchanges = exchanges;
  f->data.mode = FMU_INSTANTIATED;
  f->data.stop = HUGE_VAL;
  f->data.stale = 1;
  fmu_defaults(f->data.state);
}

/* Where a variable that others follow from is kept; NULL for the others. */
static double* fmu_place(FmuData* d, unsigned reference) {
  switch (reference) {
    case FMU_TIME:
      return &d->time;
    case FMU_DISPLACEMENT:
      return &d->input.displacement;
    case FMU_VELOCITY:
      return &d->input.velocity;
    case FMU_CURRENT:
      return &d->input.current;
    default:
      break;
  }
  if (reference >= FMU_PARAMETER) {
    return &d->state[FMU_FIRST_PARAMETER + (reference - FMU_PARAMETER)];
  }
  if ((reference >= FMU_STATE) && (reference < FMU_DERIVATIVE)) {
    return &d->state[reference - FMU_STATE];
  }
  return NULL;
}

static double fmu_value(FmuData* d, unsigned reference) {
  const double* place = fmu_place(d, reference);
  double slopes[FMU_STATE_SIZE] = {0};
  fmu_update(d);
  if (place != NULL) {
    return *place;
  }
  if (reference == FMU_FORCE) {
    return fmu_force(&d->input, d->state);
  }
  fmu_derivatives(&d->input, d->state, slopes);
  return slopes[reference - FMU_DERIVATIVE];
}

/* Whether an array can be read or written and has the size that it must have. */
static int fmu_takes(const FmuInstance* f, const char* function, const void* array, size_t size,
                     size_t expected) {
  if (size != expected) {
    fmu_fail(f, function, "got %lu values instead of %lu", (unsigned long)size, (unsigned long)expected);
    return 0;
  }
  if ((array == NULL) && (size > 0)) {
    fmu_fail(f, function, "got a null pointer");
    return 0;
  }
  return 1;
}

static int fmu_all_finite(const FmuInstance* f, const char* function, const double* values, size_t count) {
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

static int fmu_check_new_value(const FmuInstance* f, const char* function, unsigned reference, double value) {
  if (reference >= FMU_VARIABLES) {
    return fmu_fail(f, function, "there is no variable with value reference %u", reference);
  }
  if ((reference == FMU_TIME) || ((reference >= FMU_FORCE) && (reference < FMU_PARAMETER))) {
    return fmu_fail(f, function, "%s is neither an input nor a parameter", fmu_names[reference]);
  }
  if (!isfinite(value)) {
    return fmu_fail(f, function, "the value for %s is not a finite number", fmu_names[reference]);
  }
  if (reference >= FMU_PARAMETER) {
    const double* range = fmu_ranges[reference - FMU_PARAMETER];
    if (f->data.mode == FMU_CONTINUOUS) {
      return fmu_fail(f, function, "parameters change in event mode only");
    }
    if ((value < range[0]) || (value > range[1])) {
      return fmu_fail(f, function, "%s = %g is outside %g ... %g", fmu_names[reference], value, range[0],
                      range[1]);
    }
  }
  return FMU_OK;
}

/* All of them or, on an error, none. */
static int fmu_set(FmuInstance* f, const char* function, const unsigned* references, size_t count,
                   const double* values) {
  FmuData* d;
  int parameters = 0;
  size_t k;
  if (!fmu_may(f, function, FMU_ANY & ~FMU_TERMINATED) || !fmu_takes(f, function, references, count, count) ||
      !fmu_takes(f, function, values, count, count)) {
    return FMU_ERROR;
  }
  d = &f->data;
  for (k = 0; k < count; ++k) {
    if (fmu_check_new_value(f, function, references[k], values[k]) != FMU_OK) {
      return FMU_ERROR;
    }
    parameters = parameters || (references[k] >= FMU_PARAMETER);
  }
  if (parameters && (d->mode == FMU_STEP)) {
    fmu_settle(d); /* the step that ends here was made with the old ones */
  }
  for (k = 0; k < count; ++k) {
    *fmu_place(d, references[k]) = values[k];
  }
  if (parameters) {
    memcpy(d->past, d->state, sizeof d->past);
  }
  if ((count > 0) && ((d->mode & (FMU_INSTANTIATED | FMU_INITIALIZATION | FMU_STEP)) != 0)) {
    d->stale = 1;
  }
  return FMU_OK;
}

#endif
