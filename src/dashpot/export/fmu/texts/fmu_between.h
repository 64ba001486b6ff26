#ifndef FMU_BETWEEN_H
#define FMU_BETWEEN_H

/* The inputs at a share of the way from one communication point to the next: they are linear in
 * between. */
static void fmu_between(const double* from, const double* to, double share, double* inputs) {
  int k;
  for (k = 0; k < FMU_INPUTS; ++k) {
    inputs[k] = from[k] + share * (to[k] - from[k]);
  }
}

#endif
