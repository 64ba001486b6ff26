/* Yield stress over |current|: straight between points, held beyond them. */
static inline double yield_stress_at(const double* currents, const double* stresses, int count,
                                     double current) {
  const double i = fabs(current);
  double stress = stresses[count - 1];
  int k = 0;
  while ((k < count) && (currents[k] <= i)) {
    ++k;
  }
  if (k == 0) {
    stress = stresses[0];
  } else if (k < count) {
    const double share = (i - currents[k - 1]) / (currents[k] - currents[k - 1]);
    stress = stresses[k - 1] + (share * (stresses[k] - stresses[k - 1]));
  } else {
    /* beyond the last */
  }
  return stress;
}
