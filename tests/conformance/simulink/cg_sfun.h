/* Stands at the end of an S-function: steps it along the run of run.h, as Simulink does, with
 * outputs asked for twice. */
#include <math.h>
#include <stdio.h>

#include "run.h"

int main(void) {
  static SimStruct simulink;
  SimStruct* S = &simulink;
  double largest = 0, low = kRun[0][3], high = kRun[0][3];
  size_t k;
  mdlInitializeSizes(S);
  mdlInitializeSampleTimes(S);
  if (S->input_width != 3 || S->output_width != 1 || S->work_width[0] > 64 ||
      S->sample_time != SAMPLE_TIME)
    return 2;
  mdlInitializeConditions(S);
  for (k = 0; k < sizeof kRun / sizeof kRun[0]; ++k) {
    int j;
    for (j = 0; j < 3; ++j) S->inputs[j] = &kRun[k][j];
    mdlOutputs(S, 0);
    mdlOutputs(S, 0);
    mdlUpdate(S, 0);
    largest = fmax(largest, fabs(S->output - kRun[k][3]));
    low = fmin(low, kRun[k][3]);
    high = fmax(high, kRun[k][3]);
  }
  mdlTerminate(S);
  printf("largest difference %g of %g\n", largest, high - low);
  return largest <= 1e-12 * (high - low) ? 0 : 1;
}
