/* FMI 3.0 for what fmu_model.h names: the functions of the standard, declared here as it describes
 * them. */
#include "fmi3_absent.h"
#include "fmu_derivative.h"
#include "fmu_run.h"
#include "fmu_snapshot.h"

/* A null pointer where the arguments do not fit this FMU. */
static fmi3Instance instantiate(const char* function, const Instance* wanted, fmi3String name,
                                fmi3String token, int exchanges) {
  Instance* i;
  if (name == NULL) {
    fmu_fail(&wanted->fmu, function, "the instance has no name");
    return NULL;
  }
  if ((token == NULL) || (strcmp(token, FMU_TOKEN) != 0)) {
    fmu_fail(&wanted->fmu, function, "the instantiation token is not that of this FMU, " FMU_TOKEN);
    return NULL;
  }

  /* All fits: an instance of its own, started. */
  i = calloc(1, sizeof *i);
  if (i == NULL) {
    fmu_fail(&wanted->fmu, function, "there is no memory left");
    return NULL;
  }
  *i = *wanted;
  i->fmu.allocate = calloc;
  i->fmu.release = free;
  fmu_start(&i->fmu, exchanges);
  return i;
}

static Instance instance_of(fmi3LogMessageCallback log, fmi3InstanceEnvironment environment) {
  Instance wanted;
  memset(&wanted, 0, sizeof wanted);
  wanted.fmu.report = report;
  wanted.log = log;
  wanted.environment = environment;
  return wanted;
}

FMI3_API const char* fmi3GetVersion(void) { return "3.0"; }

FMI3_API fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn,
                                        size_t nCategories, const fmi3String categories[]) {
  (void)loggingOn; /* errors are all there is to log, and they always are */
  return (fmu_may(instance, "fmi3SetDebugLogging", FMU_ANY) &&
          fmu_takes(instance, "fmi3SetDebugLogging", categories, nCategories, nCategories))
             ? fmi3OK
             : fmi3Error;
}

FMI3_API fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName,
                                                   fmi3String instantiationToken,
                                                   fmi3String resourcePath, fmi3Boolean visible,
                                                   fmi3Boolean loggingOn,
                                                   fmi3InstanceEnvironment instanceEnvironment,
                                                   fmi3LogMessageCallback logMessage) {
  const Instance wanted = instance_of(logMessage, instanceEnvironment);
  (void)resourcePath;
  (void)visible;
  (void)loggingOn;

  /* Whoever knows not all continuous states cannot leave them to an integrator. */
  if (!FMU_EXCHANGES) {
    fmu_fail(&wanted.fmu, "fmi3InstantiateModelExchange", "this FMU is for co-simulation only");
    return NULL;
  }
  return instantiate("fmi3InstantiateModelExchange", &wanted, instanceName, instantiationToken, 1);
}

FMI3_API fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
    fmi3Boolean visible, fmi3Boolean loggingOn, fmi3Boolean eventModeUsed,
    fmi3Boolean earlyReturnAllowed, const fmi3ValueReference requiredIntermediateVariables[],
    size_t nRequiredIntermediateVariables, fmi3InstanceEnvironment instanceEnvironment,
    fmi3LogMessageCallback logMessage, fmi3IntermediateUpdateCallback intermediateUpdate) {
  const Instance wanted = instance_of(logMessage, instanceEnvironment);
  (void)resourcePath;
  (void)visible;
  (void)loggingOn;
  (void)earlyReturnAllowed;
  (void)requiredIntermediateVariables;
  (void)intermediateUpdate;

  /* An importer that asks for more than there is gets no instance. */
  if (eventModeUsed || (nRequiredIntermediateVariables > 0)) {
    fmu_fail(&wanted.fmu, "fmi3InstantiateCoSimulation",
             "this FMU has no event mode and no intermediate update");
    return NULL;
  }
  return instantiate("fmi3InstantiateCoSimulation", &wanted, instanceName, instantiationToken, 0);
}

FMI3_API fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
    fmi3Boolean visible, fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment,
    fmi3LogMessageCallback logMessage, fmi3ClockUpdateCallback clockUpdate,
    fmi3LockPreemptionCallback lockPreemption, fmi3UnlockPreemptionCallback unlockPreemption) {
  (void)instanceName;
  (void)instantiationToken;
  (void)resourcePath;
  (void)visible;
  (void)loggingOn;
  (void)clockUpdate;
  (void)lockPreemption;
  (void)unlockPreemption;

  const Instance wanted = instance_of(logMessage, instanceEnvironment);
  fmu_fail(&wanted.fmu, "fmi3InstantiateScheduledExecution", "is not supported");
  return NULL;
}

FMI3_API void fmi3FreeInstance(fmi3Instance instance) { free(instance); }

FMI3_API fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined,
                                                fmi3Float64 tolerance, fmi3Float64 startTime,
                                                fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
  const char* function = "fmi3EnterInitializationMode";
  const int status =
      fmu_schedule(instance, function, startTime, stopTimeDefined ? stopTime : HUGE_VAL);
  (void)toleranceDefined;
  (void)tolerance;
  return (status == FMU_OK) ? (fmi3Status)fmu_enter_initialization(instance, function) : fmi3Error;
}

FMI3_API fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return (fmi3Status)fmu_exit_initialization(instance, "fmi3ExitInitializationMode");
}

FMI3_API fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
  return (fmi3Status)fmu_go(instance, "fmi3EnterEventMode", FMU_CONTINUOUS | FMU_EVENT, FMU_EVENT);
}

FMI3_API fmi3Status fmi3Terminate(fmi3Instance instance) {
  return (fmi3Status)fmu_go(instance, "fmi3Terminate", FMU_EVENT | FMU_CONTINUOUS | FMU_STEP,
                            FMU_TERMINATED);
}

FMI3_API fmi3Status fmi3Reset(fmi3Instance instance) {
  if (!fmu_may(instance, "fmi3Reset", FMU_ANY)) {
    return fmi3Error;
  }
  fmu_start(instance, ((FmuInstance*)instance)->data.exchanges);
  return fmi3OK;
}

FMI3_API fmi3Status fmi3GetFloat64(fmi3Instance instance,
                                   const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, fmi3Float64 values[], size_t nValues) {
  return (fmu_may(instance, "fmi3GetFloat64", FMU_ANY) &&
          fmu_takes(instance, "fmi3GetFloat64", values, nValues, nValueReferences))
             ? (fmi3Status)fmu_get(instance, "fmi3GetFloat64", valueReferences, nValueReferences,
                                   values)
             : fmi3Error;
}

FMI3_API fmi3Status fmi3SetFloat64(fmi3Instance instance,
                                   const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, const fmi3Float64 values[],
                                   size_t nValues) {
  return (fmu_may(instance, "fmi3SetFloat64", FMU_ANY) &&
          fmu_takes(instance, "fmi3SetFloat64", values, nValues, nValueReferences))
             ? (fmi3Status)fmu_set(instance, "fmi3SetFloat64", valueReferences, nValueReferences,
                                   values)
             : fmi3Error;
}

FMI3_API fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* FMUState) {
  return (fmi3Status)fmu_save(instance, "fmi3GetFMUState", FMUState);
}

FMI3_API fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState) {
  return (fmi3Status)fmu_restore(instance, "fmi3SetFMUState", FMUState);
}

FMI3_API fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* FMUState) {
  return (fmi3Status)fmu_forget(instance, "fmi3FreeFMUState", FMUState);
}

FMI3_API fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState,
                                               size_t* size) {
  return (fmi3Status)fmu_snapshot_size(instance, "fmi3SerializedFMUStateSize", FMUState, size);
}

FMI3_API fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState,
                                          fmi3Byte serializedState[], size_t size) {
  return (fmi3Status)fmu_serialize(instance, "fmi3SerializeFMUState", FMUState, serializedState,
                                   size);
}

FMI3_API fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[],
                                            size_t size, fmi3FMUState* FMUState) {
  return (fmi3Status)fmu_deserialize(instance, "fmi3DeserializeFMUState", serializedState, size,
                                     FMUState);
}

FMI3_API fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance,
                                                 const fmi3ValueReference unknowns[],
                                                 size_t nUnknowns,
                                                 const fmi3ValueReference knowns[], size_t nKnowns,
                                                 const fmi3Float64 seed[], size_t nSeed,
                                                 fmi3Float64 sensitivity[], size_t nSensitivity) {
  const FmuDirection way = {unknowns, knowns, nUnknowns, nKnowns, seed};
  return (fmu_may(instance, "fmi3GetDirectionalDerivative", FMU_ANY) &&
          fmu_takes(instance, "fmi3GetDirectionalDerivative", seed, nSeed, nKnowns) &&
          fmu_takes(instance, "fmi3GetDirectionalDerivative", sensitivity, nSensitivity, nUnknowns))
             ? (fmi3Status)fmu_differentiate(instance, "fmi3GetDirectionalDerivative", &way,
                                             sensitivity)
             : fmi3Error;
}

FMI3_API fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
  return fmu_may(instance, "fmi3EvaluateDiscreteStates", FMU_INITIALIZATION | FMU_EVENT)
             ? fmi3OK
             : fmi3Error;
}

FMI3_API fmi3Status fmi3UpdateDiscreteStates(
    fmi3Instance instance, fmi3Boolean* discreteStatesNeedUpdate, fmi3Boolean* terminateSimulation,
    fmi3Boolean* nominalsOfContinuousStatesChanged, fmi3Boolean* valuesOfContinuousStatesChanged,
    fmi3Boolean* nextEventTimeDefined, fmi3Float64* nextEventTime) {
  fmi3Boolean* const answers[] = {discreteStatesNeedUpdate, terminateSimulation,
                                  nominalsOfContinuousStatesChanged,
                                  valuesOfContinuousStatesChanged, nextEventTimeDefined};
  size_t k;
  if (!fmu_may(instance, "fmi3UpdateDiscreteStates", FMU_EVENT) ||
      !fmu_takes(instance, "fmi3UpdateDiscreteStates", nextEventTime, 1, 1)) {
    return fmi3Error;
  }

  /* There are no discrete states and no events to come: every answer is no. */
  for (k = 0; k < sizeof answers / sizeof *answers; ++k) {
    if (!fmu_takes(instance, "fmi3UpdateDiscreteStates", answers[k], 1, 1)) {
      return fmi3Error;
    }
    *answers[k] = false;
  }
  *nextEventTime = 0;
  return fmi3OK;
}

FMI3_API fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
  return (fmi3Status)fmu_go(instance, "fmi3EnterContinuousTimeMode", FMU_EVENT, FMU_CONTINUOUS);
}

FMI3_API fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance,
                                                fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                                fmi3Boolean* enterEventMode,
                                                fmi3Boolean* terminateSimulation) {
  (void)noSetFMUStatePriorToCurrentPoint;
  if (!fmu_may(instance, "fmi3CompletedIntegratorStep", FMU_CONTINUOUS) ||
      !fmu_takes(instance, "fmi3CompletedIntegratorStep", enterEventMode, 1, 1) ||
      !fmu_takes(instance, "fmi3CompletedIntegratorStep", terminateSimulation, 1, 1)) {
    return fmi3Error;
  }
  *enterEventMode = false;
  *terminateSimulation = false;
  return fmi3OK;
}

FMI3_API fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
  return (fmi3Status)fmu_set_time(instance, "fmi3SetTime", time);
}

FMI3_API fmi3Status fmi3SetContinuousStates(fmi3Instance instance,
                                            const fmi3Float64 continuousStates[],
                                            size_t nContinuousStates) {
  return (fmi3Status)fmu_set_states(instance, "fmi3SetContinuousStates", continuousStates,
                                    nContinuousStates);
}

FMI3_API fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance,
                                                      fmi3Float64 derivatives[],
                                                      size_t nContinuousStates) {
  return (fmi3Status)fmu_get_states(instance, "fmi3GetContinuousStateDerivatives", FMU_DERIVATIVE,
                                    derivatives, nContinuousStates);
}

FMI3_API fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[],
                                           size_t nEventIndicators) {
  return (fmu_may(instance, "fmi3GetEventIndicators",
                  FMU_INITIALIZATION | FMU_EVENT | FMU_CONTINUOUS) &&
          fmu_takes(instance, "fmi3GetEventIndicators", eventIndicators, nEventIndicators, 0))
             ? fmi3OK
             : fmi3Error;
}

FMI3_API fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[],
                                            size_t nContinuousStates) {
  return (fmi3Status)fmu_get_states(instance, "fmi3GetContinuousStates", FMU_STATE,
                                    continuousStates, nContinuousStates);
}

FMI3_API fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[],
                                                      size_t nContinuousStates) {
  return (fmi3Status)fmu_get_nominals(instance, "fmi3GetNominalsOfContinuousStates", nominals,
                                      nContinuousStates);
}

FMI3_API fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance,
                                                   size_t* nEventIndicators) {
  if (!fmu_may(instance, "fmi3GetNumberOfEventIndicators", FMU_ANY) ||
      !fmu_takes(instance, "fmi3GetNumberOfEventIndicators", nEventIndicators, 1, 1)) {
    return fmi3Error;
  }
  *nEventIndicators = 0;
  return fmi3OK;
}

FMI3_API fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance,
                                                    size_t* nContinuousStates) {
  if (!fmu_may(instance, "fmi3GetNumberOfContinuousStates", FMU_ANY) ||
      !fmu_takes(instance, "fmi3GetNumberOfContinuousStates", nContinuousStates, 1, 1)) {
    return fmi3Error;
  }
  *nContinuousStates = FMU_STATES;
  return fmi3OK;
}

FMI3_API fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint,
                               fmi3Float64 communicationStepSize,
                               fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                               fmi3Boolean* eventHandlingNeeded, fmi3Boolean* terminateSimulation,
                               fmi3Boolean* earlyReturn, fmi3Float64* lastSuccessfulTime) {
  (void)noSetFMUStatePriorToCurrentPoint;
  if (!fmu_may(instance, "fmi3DoStep", FMU_STEP) ||
      !fmu_takes(instance, "fmi3DoStep", eventHandlingNeeded, 1, 1) ||
      !fmu_takes(instance, "fmi3DoStep", terminateSimulation, 1, 1) ||
      !fmu_takes(instance, "fmi3DoStep", earlyReturn, 1, 1) ||
      !fmu_takes(instance, "fmi3DoStep", lastSuccessfulTime, 1, 1)) {
    return fmi3Error;
  }

  /* A step is made to its end or not at all. */
  *eventHandlingNeeded = false;
  *terminateSimulation = false;
  *earlyReturn = false;
  *lastSuccessfulTime = ((FmuInstance*)instance)->data.time;
  if (fmu_do_step(instance, "fmi3DoStep", currentCommunicationPoint, communicationStepSize) !=
      FMU_OK) {
    return fmi3Error;
  }
  *lastSuccessfulTime = ((FmuInstance*)instance)->data.time;
  return fmi3OK;
}
