/* force = damper_mex(input): the force, N, along the rows [displacement m, velocity m/s, command]
 * of a matrix, DAMPER_SAMPLE_TIME apart, from rest at the first. For MATLAB and Octave:
 *
 *   mex damper_mex.c damper_model.c              (MATLAB)
 *   mkoctfile --mex damper_mex.c damper_model.c  (Octave)
 */
#include <mex.h>

#include "damper.h"

static damper_input row_of(const double* input, mwSize count, mwSize k) {
  damper_input row;
  row.displacement = input[k];
  row.velocity = input[count + k];
  row.current = input[(2 * count) + k];
  return row;
}

void mexFunction(int outputs, mxArray* output[], int inputs, const mxArray* input[]) {
  damper_model model;
  double* force;
  mwSize count, k;
  if ((inputs != 1) || !mxIsDouble(input[0]) || mxIsComplex(input[0]) || mxIsSparse(input[0]) ||
      (mxGetN(input[0]) != 3)) {
    mexErrMsgTxt(
        "it takes one matrix, not a sparse one, with the columns displacement, velocity, command");
  }
  if (outputs > 1) {
    mexErrMsgTxt("it gives one column, the force");
  }

  /* From rest at the first row, then step by step. */
  count = mxGetM(input[0]);
  output[0] = mxCreateDoubleMatrix(count, 1, mxREAL);
  force = mxGetPr(output[0]);
  for (k = 0; k < count; ++k) {
    const damper_input row = row_of(mxGetPr(input[0]), count, k);
    if (k == 0) {
      damper_reset(&model, &row);
      force[0] = damper_force(&row, model.state);
    } else {
      force[k] = damper_step(&model, &row);
    }
  }
}
