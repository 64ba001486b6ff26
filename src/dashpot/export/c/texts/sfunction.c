/* A level-2 S-function for Simulink: input [displacement m, velocity m/s, command], output the
 * force, N, every DAMPER_SAMPLE_TIME, from rest at the first. In MATLAB:
 *
 *   mex damper_sfun.c damper_model.c
 *
 * then an S-Function block with the name damper_sfun.
 */
#define S_FUNCTION_NAME damper_sfun
#define S_FUNCTION_LEVEL 2
#include <simstruc.h>

#include "damper.h"

/* The model is kept in numbers of Simulink's, so that it is saved with the state of a simulation.
 */
#define MODEL_NUMBERS ((sizeof(damper_model) + sizeof(real_T) - 1) / sizeof(real_T))
enum { MODEL, STARTED, WORKS };

static damper_input input_of(SimStruct* S) {
  InputRealPtrsType u = ssGetInputPortRealSignalPtrs(S, 0);
  damper_input input;
  input.displacement = *u[0];
  input.velocity = *u[1];
  input.current = *u[2];
  return input;
}

/* The force at this input, the model then being the one after it. */
static double force_of(damper_model* model, int started, const damper_input* input) {
  if (started) {
    return damper_step(model, input);
  }
  damper_reset(model, input);
  return damper_force(input, model->state);
}

static void mdlInitializeSizes(SimStruct* S) {
  ssSetNumSFcnParams(S, 0);
  if (!ssSetNumInputPorts(S, 1) || !ssSetNumOutputPorts(S, 1)) {
    return;
  }
  ssSetInputPortWidth(S, 0, 3);
  ssSetInputPortDirectFeedThrough(S, 0, 1);
  ssSetOutputPortWidth(S, 0, 1);
  ssSetNumSampleTimes(S, 1);
  ssSetNumDWork(S, WORKS);
  ssSetDWorkWidth(S, MODEL, MODEL_NUMBERS);
  ssSetDWorkDataType(S, MODEL, SS_DOUBLE);
  ssSetDWorkWidth(S, STARTED, 1);
  ssSetDWorkDataType(S, STARTED, SS_DOUBLE);
}

static void mdlInitializeSampleTimes(SimStruct* S) {
  ssSetSampleTime(S, 0, DAMPER_SAMPLE_TIME);
  ssSetOffsetTime(S, 0, 0.0);
}

#define MDL_INITIALIZE_CONDITIONS
static void mdlInitializeConditions(SimStruct* S) { *(real_T*)ssGetDWork(S, STARTED) = 0; }

/* Outputs may be asked for more than once a step: the model itself goes on in mdlUpdate. */
static void mdlOutputs(SimStruct* S, int_T task) {
  damper_model trial = *(const damper_model*)ssGetDWork(S, MODEL);
  const damper_input input = input_of(S);
  (void)task;
  ssGetOutputPortRealSignal(S, 0)[0] =
      force_of(&trial, *(real_T*)ssGetDWork(S, STARTED) != 0, &input);
}

#define MDL_UPDATE
static void mdlUpdate(SimStruct* S, int_T task) {
  real_T* started = (real_T*)ssGetDWork(S, STARTED);
  const damper_input input = input_of(S);
  (void)task;
  (void)force_of((damper_model*)ssGetDWork(S, MODEL), *started != 0, &input);
  *started = 1;
}

static void mdlTerminate(SimStruct* S) { (void)S; }

#ifdef MATLAB_MEX_FILE
#include <simulink.c>
#else
#include <cg_sfun.h>
#endif
