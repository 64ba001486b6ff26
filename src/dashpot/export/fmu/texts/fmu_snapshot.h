/* The state of an FMU as a block of memory or of bytes. */
#ifndef FMU_SNAPSHOT_H
#define FMU_SNAPSHOT_H
#include "fmu.h"

/* Whether this block is the state of such an FMU at work in the same way. */
static int fmu_is_snapshot(const FmuInstance* f, const char* function, const FmuData* d) {
  const int modes = FMU_INSTANTIATED | FMU_INITIALIZATION | FMU_TERMINATED |
                    ((f->data.exchanges != 0) ? (FMU_EVENT | FMU_CONTINUOUS) : FMU_STEP);
  if (memcmp(d->token, FMU_TOKEN, sizeof FMU_TOKEN) != 0 || d->exchanges != f->data.exchanges ||
      (d->mode & modes) == 0 || (d->mode & (d->mode - 1)) != 0) {
    fmu_fail(f, function, "this is not a state of this FMU");
    return 0;
  }
  return 1;
}

static int fmu_save(FmuInstance* f, const char* function, void** snapshot) {
  if (!fmu_may(f, function, FMU_ANY) || !fmu_takes(f, function, snapshot, 1, 1)) {
    return FMU_ERROR;
  }
  if (*snapshot == NULL) {
    *snapshot = f->allocate(1, sizeof(FmuData));
    if (*snapshot == NULL) {
      return fmu_fail(f, function, "there is no memory left");
    }
  }
  memcpy(*snapshot, &f->data, sizeof(FmuData));
  return FMU_OK;
}

static int fmu_restore(FmuInstance* f, const char* function, const void* snapshot) {
  if (!fmu_may(f, function, FMU_ANY) || !fmu_takes(f, function, snapshot, 1, 1) ||
      !fmu_is_snapshot(f, function, (const FmuData*)snapshot)) {
    return FMU_ERROR;
  }
  memcpy(&f->data, snapshot, sizeof(FmuData));
  return FMU_OK;
}

static int fmu_forget(FmuInstance* f, const char* function, void** snapshot) {
  if (!fmu_may(f, function, FMU_ANY)) {
    return FMU_ERROR;
  }
  if ((snapshot != NULL) && (*snapshot != NULL)) {
    f->release(*snapshot);
    *snapshot = NULL;
  }
  return FMU_OK;
}

static int fmu_snapshot_size(FmuInstance* f, const char* function, const void* snapshot,
                             size_t* size) {
  if (!fmu_may(f, function, FMU_ANY) || !fmu_takes(f, function, snapshot, 1, 1) ||
      !fmu_takes(f, function, size, 1, 1)) {
    return FMU_ERROR;
  }
  *size = sizeof(FmuData);
  return FMU_OK;
}

static int fmu_serialize(FmuInstance* f, const char* function, const void* snapshot, void* bytes,
                         size_t size) {
  if (!fmu_may(f, function, FMU_ANY) || !fmu_takes(f, function, snapshot, 1, 1) ||
      !fmu_takes(f, function, bytes, size, sizeof(FmuData))) {
    return FMU_ERROR;
  }
  memcpy(bytes, snapshot, size);
  return FMU_OK;
}

static int fmu_deserialize(FmuInstance* f, const char* function, const void* bytes, size_t size,
                           void** snapshot) {
  FmuData data;
  if (!fmu_may(f, function, FMU_ANY) || !fmu_takes(f, function, bytes, size, sizeof data) ||
      !fmu_takes(f, function, snapshot, 1, 1)) {
    return FMU_ERROR;
  }

  /* Bytes of another FMU, or of none, are refused before anything is written. */
  memcpy(&data, bytes, size);
  if (!fmu_is_snapshot(f, function, &data)) {
    return FMU_ERROR;
  }
  if (*snapshot == NULL) {
    *snapshot = f->allocate(1, sizeof data);
    if (*snapshot == NULL) {
      return fmu_fail(f, function, "there is no memory left");
    }
  }
  memcpy(*snapshot, &data, sizeof data);
  return FMU_OK;
}

#endif
