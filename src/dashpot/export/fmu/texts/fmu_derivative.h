/* Directional derivatives of an FMU. */
#ifndef FMU_DERIVATIVE_H
#define FMU_DERIVATIVE_H
#include "fmu.h"

/* Along which knowns to differentiate which unknowns. */
typedef struct FmuDirection {
  const unsigned *unknowns, *knowns;
  size_t unknown_count, known_count;
  const double* seed;
} FmuDirection;

static int fmu_is_known(const FmuData* d, unsigned reference) {
  const int begins = (d->mode & (FMU_INSTANTIATED | FMU_INITIALIZATION)) != 0;
  return ((reference >= FMU_INPUT) && (reference < FMU_OUTPUT)) ||
         ((reference >= FMU_STATE) && (reference < FMU_DERIVATIVE) && (d->exchanges != 0) &&
          !begins) ||
         ((reference >= FMU_PARAMETER) && (reference < FMU_VARIABLES) && begins);
}

static FmuData fmu_moved(const FmuData* d, const FmuDirection* way, double length) {
  FmuData moved = *d;
  size_t k;
  for (k = 0; k < way->known_count; ++k) {
    *fmu_place(&moved, way->knowns[k]) += length * way->seed[k];
  }
  moved.stale = (d->exchanges == 0) || ((d->mode & (FMU_INSTANTIATED | FMU_INITIALIZATION)) != 0);
  return moved;
}

/* The directional derivative by central differences of 1e-5 of the variables' nominal values. */
static int fmu_differentiate(FmuInstance* f, const char* function, const FmuDirection* way,
                             double* slopes) {
  FmuData ahead, behind;
  double reach = 0;
  size_t k;
  if (!fmu_may(f, function, FMU_ANY & ~(FMU_INSTANTIATED | FMU_TERMINATED)) ||
      !fmu_takes(f, function, way->unknowns, way->unknown_count, way->unknown_count) ||
      !fmu_takes(f, function, way->knowns, way->known_count, way->known_count) ||
      !fmu_takes(f, function, way->seed, way->known_count, way->known_count) ||
      !fmu_takes(f, function, slopes, way->unknown_count, way->unknown_count) ||
      !fmu_all_finite(f, function, way->seed, way->known_count)) {
    return FMU_ERROR;
  }
  if (!FMU_DIFFERENTIABLE) {
    return fmu_fail(f, function, "is not supported: the outputs change at samples only");
  }

  /* Look at what is asked for, and how far the seed reaches in nominal values. */
  for (k = 0; k < way->known_count; ++k) {
    if (!fmu_is_known(&f->data, way->knowns[k])) {
      return fmu_fail(f, function, "value reference %u is not a known", way->knowns[k]);
    }
    reach = fmax(reach, fabs(way->seed[k]) / fmu_nominals[way->knowns[k]]);
  }
  for (k = 0; k < way->unknown_count; ++k) {
    if ((way->unknowns[k] < FMU_OUTPUT) || (way->unknowns[k] >= FMU_PARAMETER)) {
      return fmu_fail(f, function, "value reference %u is not an unknown", way->unknowns[k]);
    }
  }

  /* A copy of the FMU on either side; their difference over the way between them. */
  fmu_update(&f->data);
  ahead = fmu_moved(&f->data, way, (reach > 0) ? 1e-5 / reach : 0);
  behind = fmu_moved(&f->data, way, (reach > 0) ? -1e-5 / reach : 0);
  for (k = 0; k < way->unknown_count; ++k) {
    const double rise = fmu_value(&ahead, way->unknowns[k]) - fmu_value(&behind, way->unknowns[k]);
    slopes[k] = rise * reach / 2e-5;
  }
  return fmu_all_finite(f, function, slopes, way->unknown_count) ? FMU_OK : FMU_ERROR;
}

#endif
