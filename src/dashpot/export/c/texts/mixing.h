/* Signals of their own out of such that tell much the same: mixed = T (raw - mean), T lower
 * triangular, row by row without its zeros. */
static inline void mixing_apply(const double* mean, const double* rows, int count,
                                const double* raw, double* mixed) {
  int k, j, at = 0;
  for (k = 0; k < count; ++k) {
    double sum = 0;
    for (j = 0; j <= k; ++j) {
      sum += rows[at] * (raw[j] - mean[j]);
      ++at;
    }
    mixed[k] = sum;
  }
}
