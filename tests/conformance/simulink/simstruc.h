/* As much of Simulink's interface to an S-function as the exported one uses: its own numbers, no
 * Simulink. */
#ifndef SIMSTRUC_H
#define SIMSTRUC_H
#include <stddef.h>

typedef double real_T;
typedef int int_T;
typedef const real_T* const* InputRealPtrsType;
enum { SS_DOUBLE };

typedef struct SimStruct {
  int parameters, input_ports, output_ports, input_width, output_width, feedthrough, sample_times,
      works;
  double sample_time, offset_time;
  const real_T* inputs[3];
  real_T output;
  real_T work[2][64];
  size_t work_width[2];
} SimStruct;

#define ssSetNumSFcnParams(S, n) ((S)->parameters = (n))
#define ssSetNumInputPorts(S, n) ((S)->input_ports = (n))
#define ssSetNumOutputPorts(S, n) ((S)->output_ports = (n))
#define ssSetInputPortWidth(S, port, n) ((S)->input_width = (n))
#define ssSetInputPortDirectFeedThrough(S, port, yes) ((S)->feedthrough = (yes))
#define ssSetOutputPortWidth(S, port, n) ((S)->output_width = (n))
#define ssSetNumSampleTimes(S, n) ((S)->sample_times = (n))
#define ssSetNumDWork(S, n) ((S)->works = (n))
#define ssSetDWorkWidth(S, k, n) ((S)->work_width[k] = (n))
#define ssSetDWorkDataType(S, k, type) ((void)(S), (void)(type))
#define ssGetDWork(S, k) ((void*)(S)->work[k])
#define ssSetSampleTime(S, k, t) ((S)->sample_time = (t))
#define ssSetOffsetTime(S, k, t) ((S)->offset_time = (t))
#define ssGetInputPortRealSignalPtrs(S, port) ((InputRealPtrsType)(S)->inputs)
#define ssGetOutputPortRealSignal(S, port) (&(S)->output)

#endif
