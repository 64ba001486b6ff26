/* An FMU's start, steps and end, and the functions that an integrator calls. */
#ifndef FMU_RUN_H
#define FMU_RUN_H
#include "fmu.h"

static int fmu_enter_initialization(FmuInstance* f, const char* function) {
  if (!fmu_may(f, function, FMU_INSTANTIATED)) {
    return FMU_ERROR;
  }
  f->data.mode = FMU_INITIALIZATION;
  f->data.stale = 1;
  return FMU_OK;
}

static int fmu_exit_initialization(FmuInstance* f, const char* function) {
  if (!fmu_may(f, function, FMU_INITIALIZATION)) {
    return FMU_ERROR;
  }
  fmu_settle(&f->data);
  f->data.mode = (f->data.exchanges != 0) ? FMU_EVENT : FMU_STEP;
  return FMU_OK;
}

static int fmu_go(FmuInstance* f, const char* function, int from, int to) {
  if (!fmu_may(f, function, from)) {
    return FMU_ERROR;
  }
  fmu_update(&f->data);
  f->data.mode = to;
  return FMU_OK;
}

/* When the experiment runs; `stop` is HUGE_VAL where it is open. */
static int fmu_schedule(FmuInstance* f, const char* function, double start, double stop) {
  if (!fmu_may(f, function, FMU_INSTANTIATED)) {
    return FMU_ERROR;
  }
  if (!isfinite(start) || !(stop >= start)) {
    return fmu_fail(f, function, "cannot run from %g s to %g s", start, stop);
  }
  f->data.time = start;
  f->data.stop = stop;
  return FMU_OK;
}

static int fmu_do_step(FmuInstance* f, const char* function, double point, double step) {
  FmuData* d;
  if (!fmu_may(f, function, FMU_STEP)) {
    return FMU_ERROR;
  }

  /* A step must be possible, begin where the last one ended, and end before the stop time. */
  d = &f->data;
  if (!((step >= 0) && (step <= FMU_LONGEST_STEP)) || !isfinite(step)) {
    return fmu_fail(f, function, "a step of %g s is impossible", step);
  }
  if (!(fabs(point - d->time) <= 1e-9 * (1 + fabs(d->time)))) {
    return fmu_fail(f, function, "begins at %g s but the last step ended at %g s", point, d->time);
  }
  if (point + step > d->stop + 1e-9 * (1 + fabs(d->stop))) {
    return fmu_fail(f, function, "goes beyond the stop time, %g s", d->stop);
  }

  /* Finish the step before; this one is made when its end is asked for, with the inputs that are
   * set by then. */
  fmu_settle(d);
  d->since = step;
  d->time = point + step;
  d->stale = 1;
  return FMU_OK;
}

static int fmu_set_time(FmuInstance* f, const char* function, double time) {
  if (!fmu_may(f, function, FMU_EVENT | FMU_CONTINUOUS)) {
    return FMU_ERROR;
  }
  if (!isfinite(time)) {
    return fmu_fail(f, function, "the time is not a finite number");
  }
  f->data.time = time;
  return FMU_OK;
}

static int fmu_set_states(FmuInstance* f, const char* function, const double* states,
                          size_t count) {
  if (!fmu_may(f, function, FMU_EVENT | FMU_CONTINUOUS) ||
      !fmu_takes(f, function, states, count, FMU_STATES) ||
      !fmu_all_finite(f, function, states, count)) {
    return FMU_ERROR;
  }
  if (count > 0) {
    memcpy(fmu_numbers(&f->data.state), states, count * sizeof *states);
  }
  return FMU_OK;
}

/* The continuous states, their derivatives or their nominal values: those from value reference
 * `first` on. */
static int fmu_get_states(FmuInstance* f, const char* function, unsigned first, double* values,
                          size_t count) {
  const int modes = FMU_INITIALIZATION | FMU_EVENT | FMU_CONTINUOUS | FMU_TERMINATED;
  size_t k;
  if (!fmu_may(f, function, modes) || !fmu_takes(f, function, values, count, FMU_STATES)) {
    return FMU_ERROR;
  }
  for (k = 0; k < count; ++k) {
    values[k] = fmu_value(&f->data, first + (unsigned)k);
  }
  return fmu_all_finite(f, function, values, count) ? FMU_OK : FMU_ERROR;
}

static int fmu_get_nominals(FmuInstance* f, const char* function, double* values, size_t count) {
  if (!fmu_may(f, function, FMU_ANY) || !fmu_takes(f, function, values, count, FMU_STATES)) {
    return FMU_ERROR;
  }
  if (count > 0) {
    memcpy(values, fmu_nominals + FMU_STATE, count * sizeof *values);
  }
  return FMU_OK;
}

#endif
