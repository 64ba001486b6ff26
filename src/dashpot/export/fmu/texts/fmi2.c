/* FMI 2.0 for what fmu_model.h names: the functions of the standard, declared here as it describes
 * them. */
#include "fmu_derivative.h"
#include "fmu_run.h"
#include "fmu_snapshot.h"

#if defined(_WIN32)
#define FMI2_API __declspec(dllexport)
#elif defined(__GNUC__)
#define FMI2_API __attribute__((visibility("default")))
#else
#define FMI2_API
#endif

typedef void* fmi2Component;
typedef void* fmi2ComponentEnvironment;
typedef void* fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef const char* fmi2String;
typedef char fmi2Byte;
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum {
  fmi2DoStepStatus,
  fmi2PendingStatus,
  fmi2LastSuccessfulTime,
  fmi2Terminated
} fmi2StatusKind;

typedef struct {
  void (*logger)(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                 fmi2String category, fmi2String message, ...);
  void* (*allocateMemory)(size_t count, size_t size);
  void (*freeMemory)(void* block);
  void (*stepFinished)(fmi2ComponentEnvironment environment, fmi2Status status);
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

typedef struct {
  fmi2Boolean newDiscreteStatesNeeded, terminateSimulation, nominalsOfContinuousStatesChanged;
  fmi2Boolean valuesOfContinuousStatesChanged, nextEventTimeDefined;
  fmi2Real nextEventTime;
} fmi2EventInfo;

typedef struct Component {
  FmuInstance fmu; /* first: its functions get a pointer to it */
  fmi2CallbackFunctions callbacks;
  char name[128];
} Component;

static void report(const FmuInstance* f, const char* message) {
  const Component* c = (const Component*)(const void*)f;
  if (c->callbacks.logger != NULL) {
    c->callbacks.logger(c->callbacks.componentEnvironment, c->name, fmi2Error, "logStatusError",
                        message);
  }
}

/* A function that this FMU does not have: an error once the caller has an instance. */
static fmi2Status unsupported(fmi2Component c, const char* function) {
  return fmu_may(c, function, FMU_ANY) ? (fmi2Status)fmu_fail(c, function, "is not supported")
                                       : fmi2Error;
}

/* Every variable is real: asking for none of another type is fine. */
static fmi2Status no_variables(fmi2Component c, const char* function, size_t count) {
  if (!fmu_may(c, function, FMU_ANY)) {
    return fmi2Error;
  }
  return (count == 0) ? fmi2OK
                      : (fmi2Status)fmu_fail(c, function, "there are no variables of this type");
}

FMI2_API const char* fmi2GetTypesPlatform(void) { return "default"; }

FMI2_API const char* fmi2GetVersion(void) { return "2.0"; }

FMI2_API fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                                        const fmi2String categories[]) {
  (void)loggingOn; /* errors are all there is to log, and they always are */
  return (fmu_may(c, "fmi2SetDebugLogging", FMU_ANY) &&
          fmu_takes(c, "fmi2SetDebugLogging", categories, nCategories, nCategories))
             ? fmi2OK
             : fmi2Error;
}

FMI2_API fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType,
                                       fmi2String fmuGUID, fmi2String fmuResourceLocation,
                                       const fmi2CallbackFunctions* functions, fmi2Boolean visible,
                                       fmi2Boolean loggingOn) {
  Component refused, *c;
  (void)fmuResourceLocation;
  (void)visible;
  (void)loggingOn;
  if (functions == NULL) {
    return NULL;
  }

  /* Errors are reported by an instance that is never handed out. */
  memset(&refused, 0, sizeof refused);
  refused.callbacks = *functions;
  refused.fmu.report = report;
  if ((instanceName == NULL) || (instanceName[0] == '\0')) {
    fmu_fail(&refused.fmu, "fmi2Instantiate", "the instance has no name");
    return NULL;
  }
  if ((fmuGUID == NULL) || (strcmp(fmuGUID, FMU_TOKEN) != 0)) {
    fmu_fail(&refused.fmu, "fmi2Instantiate", "the GUID is not that of this FMU, " FMU_TOKEN);
    return NULL;
  }
  if ((fmuType != fmi2CoSimulation) && ((fmuType != fmi2ModelExchange) || !FMU_EXCHANGES)) {
    fmu_fail(&refused.fmu, "fmi2Instantiate", "this FMU is not of that type");
    return NULL;
  }

  /* An importer without functions for memory leaves it to the C library. */
  if ((functions->allocateMemory == NULL) || (functions->freeMemory == NULL)) {
    refused.callbacks.allocateMemory = calloc;
    refused.callbacks.freeMemory = free;
  }
  c = refused.callbacks.allocateMemory(1, sizeof *c);
  if (c == NULL) {
    fmu_fail(&refused.fmu, "fmi2Instantiate", "there is no memory left");
    return NULL;
  }
  *c = refused;
  strncpy(c->name, instanceName, sizeof c->name - 1);
  c->fmu.allocate = c->callbacks.allocateMemory;
  c->fmu.release = c->callbacks.freeMemory;
  fmu_start(&c->fmu, fmuType == fmi2ModelExchange);
  return c;
}

FMI2_API void fmi2FreeInstance(fmi2Component c) {
  if (c != NULL) {
    ((Component*)c)->callbacks.freeMemory(c);
  }
}

FMI2_API fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined,
                                        fmi2Real tolerance, fmi2Real startTime,
                                        fmi2Boolean stopTimeDefined, fmi2Real stopTime) {
  (void)toleranceDefined;
  (void)tolerance;
  return (fmi2Status)fmu_schedule(c, "fmi2SetupExperiment", startTime,
                                  stopTimeDefined ? stopTime : HUGE_VAL);
}

FMI2_API fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return (fmi2Status)fmu_enter_initialization(c, "fmi2EnterInitializationMode");
}

FMI2_API fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return (fmi2Status)fmu_exit_initialization(c, "fmi2ExitInitializationMode");
}

FMI2_API fmi2Status fmi2Terminate(fmi2Component c) {
  return (fmi2Status)fmu_go(c, "fmi2Terminate", FMU_EVENT | FMU_CONTINUOUS | FMU_STEP,
                            FMU_TERMINATED);
}

FMI2_API fmi2Status fmi2Reset(fmi2Component c) {
  if (!fmu_may(c, "fmi2Reset", FMU_ANY)) {
    return fmi2Error;
  }
  fmu_start(c, ((FmuInstance*)c)->data.exchanges);
  return fmi2OK;
}

FMI2_API fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                fmi2Real value[]) {
  return (fmi2Status)fmu_get(c, "fmi2GetReal", vr, nvr, value);
}

FMI2_API fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                const fmi2Real value[]) {
  return (fmi2Status)fmu_set(c, "fmi2SetReal", vr, nvr, value);
}

#define FMI2_NO_VARIABLES(type)                                                                 \
  FMI2_API fmi2Status fmi2Get##type(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                                    fmi2##type value[]) {                                       \
    (void)vr;                                                                                   \
    (void)value;                                                                                \
    return no_variables(c, "fmi2Get" #type, nvr);                                               \
  }                                                                                             \
  FMI2_API fmi2Status fmi2Set##type(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                                    const fmi2##type value[]) {                                 \
    (void)vr;                                                                                   \
    (void)value;                                                                                \
    return no_variables(c, "fmi2Set" #type, nvr);                                               \
  }
FMI2_NO_VARIABLES(Integer)
FMI2_NO_VARIABLES(Boolean)
FMI2_NO_VARIABLES(String)

FMI2_API fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* FMUstate) {
  return (fmi2Status)fmu_save(c, "fmi2GetFMUstate", FMUstate);
}

FMI2_API fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
  return (fmi2Status)fmu_restore(c, "fmi2SetFMUstate", FMUstate);
}

FMI2_API fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* FMUstate) {
  return (fmi2Status)fmu_forget(c, "fmi2FreeFMUstate", FMUstate);
}

FMI2_API fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate,
                                               size_t* size) {
  return (fmi2Status)fmu_snapshot_size(c, "fmi2SerializedFMUstateSize", FMUstate, size);
}

FMI2_API fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate,
                                          fmi2Byte serializedState[], size_t size) {
  return (fmi2Status)fmu_serialize(c, "fmi2SerializeFMUstate", FMUstate, serializedState, size);
}

FMI2_API fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[],
                                            size_t size, fmi2FMUstate* FMUstate) {
  return (fmi2Status)fmu_deserialize(c, "fmi2DeSerializeFMUstate", serializedState, size, FMUstate);
}

FMI2_API fmi2Status fmi2GetDirectionalDerivative(fmi2Component c,
                                                 const fmi2ValueReference vUnknown_ref[],
                                                 size_t nUnknown,
                                                 const fmi2ValueReference vKnown_ref[],
                                                 size_t nKnown, const fmi2Real dvKnown[],
                                                 fmi2Real dvUnknown[]) {
  const FmuDirection way = {vUnknown_ref, vKnown_ref, nUnknown, nKnown, dvKnown};
  return (fmi2Status)fmu_differentiate(c, "fmi2GetDirectionalDerivative", &way, dvUnknown);
}

FMI2_API fmi2Status fmi2EnterEventMode(fmi2Component c) {
  return (fmi2Status)fmu_go(c, "fmi2EnterEventMode", FMU_CONTINUOUS | FMU_EVENT, FMU_EVENT);
}

FMI2_API fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo* eventInfo) {
  if (!fmu_may(c, "fmi2NewDiscreteStates", FMU_EVENT) ||
      !fmu_takes(c, "fmi2NewDiscreteStates", eventInfo, 1, 1)) {
    return fmi2Error;
  }
  memset(eventInfo, 0, sizeof *eventInfo);
  return fmi2OK;
}

FMI2_API fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
  return (fmi2Status)fmu_go(c, "fmi2EnterContinuousTimeMode", FMU_EVENT, FMU_CONTINUOUS);
}

FMI2_API fmi2Status fmi2CompletedIntegratorStep(fmi2Component c,
                                                fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                                fmi2Boolean* enterEventMode,
                                                fmi2Boolean* terminateSimulation) {
  (void)noSetFMUStatePriorToCurrentPoint;
  if (!fmu_may(c, "fmi2CompletedIntegratorStep", FMU_CONTINUOUS) ||
      !fmu_takes(c, "fmi2CompletedIntegratorStep", enterEventMode, 1, 1) ||
      !fmu_takes(c, "fmi2CompletedIntegratorStep", terminateSimulation, 1, 1)) {
    return fmi2Error;
  }
  *enterEventMode = 0;
  *terminateSimulation = 0;
  return fmi2OK;
}

FMI2_API fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
  return (fmi2Status)fmu_set_time(c, "fmi2SetTime", time);
}

FMI2_API fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx) {
  return (fmi2Status)fmu_set_states(c, "fmi2SetContinuousStates", x, nx);
}

FMI2_API fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx) {
  return (fmi2Status)fmu_get_states(c, "fmi2GetDerivatives", FMU_DERIVATIVE, derivatives, nx);
}

FMI2_API fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni) {
  return (fmu_may(c, "fmi2GetEventIndicators", FMU_INITIALIZATION | FMU_EVENT | FMU_CONTINUOUS) &&
          fmu_takes(c, "fmi2GetEventIndicators", eventIndicators, ni, 0))
             ? fmi2OK
             : fmi2Error;
}

FMI2_API fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx) {
  return (fmi2Status)fmu_get_states(c, "fmi2GetContinuousStates", FMU_STATE, x, nx);
}

FMI2_API fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[],
                                                      size_t nx) {
  return (fmi2Status)fmu_get_nominals(c, "fmi2GetNominalsOfContinuousStates", x_nominal, nx);
}

FMI2_API fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[],
                                                size_t nvr, const fmi2Integer order[],
                                                const fmi2Real value[]) {
  (void)vr;
  (void)nvr;
  (void)order;
  (void)value;
  return unsupported(c, "fmi2SetRealInputDerivatives");
}

FMI2_API fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[],
                                                 size_t nvr, const fmi2Integer order[],
                                                 fmi2Real value[]) {
  (void)vr;
  (void)nvr;
  (void)order;
  (void)value;
  return unsupported(c, "fmi2GetRealOutputDerivatives");
}

FMI2_API fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint,
                               fmi2Real communicationStepSize,
                               fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
  (void)noSetFMUStatePriorToCurrentPoint;
  return (fmi2Status)fmu_do_step(c, "fmi2DoStep", currentCommunicationPoint, communicationStepSize);
}

FMI2_API fmi2Status fmi2CancelStep(fmi2Component c) { return unsupported(c, "fmi2CancelStep"); }

/* Every step is done when fmi2DoStep returns: only the last time can be asked for. */
FMI2_API fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status* value) {
  (void)s;
  (void)value;
  return unsupported(c, "fmi2GetStatus");
}

FMI2_API fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real* value) {
  if (s != fmi2LastSuccessfulTime) {
    return unsupported(c, "fmi2GetRealStatus");
  }
  if (!fmu_may(c, "fmi2GetRealStatus", FMU_STEP | FMU_TERMINATED) ||
      !fmu_takes(c, "fmi2GetRealStatus", value, 1, 1)) {
    return fmi2Error;
  }
  *value = ((FmuInstance*)c)->data.time;
  return fmi2OK;
}

FMI2_API fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s,
                                         fmi2Integer* value) {
  (void)s;
  (void)value;
  return unsupported(c, "fmi2GetIntegerStatus");
}

FMI2_API fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s,
                                         fmi2Boolean* value) {
  if (s != fmi2Terminated) {
    return unsupported(c, "fmi2GetBooleanStatus");
  }
  if (!fmu_may(c, "fmi2GetBooleanStatus", FMU_STEP | FMU_TERMINATED) ||
      !fmu_takes(c, "fmi2GetBooleanStatus", value, 1, 1)) {
    return fmi2Error;
  }
  *value = 0;
  return fmi2OK;
}

FMI2_API fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s,
                                        fmi2String* value) {
  (void)s;
  (void)value;
  return unsupported(c, "fmi2GetStringStatus");
}
