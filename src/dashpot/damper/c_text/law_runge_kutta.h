/* A step that laws are integrated by, as C99 text that the library takes in once per law and the C
 * export ships. Declared before: LawParameters, law_derivative and LAW_MOST_STATES.
 */

/* One classical Runge-Kutta step of length h, with p, x and v at its start, middle and end. */
static inline void law_runge_kutta(const LawParameters* const* p, const double* x, const double* v,
                                   double h, int count, double* z) {
  double k1[LAW_MOST_STATES] = {0}, k2[LAW_MOST_STATES] = {0}, k3[LAW_MOST_STATES] = {0};
  double k4[LAW_MOST_STATES] = {0}, trial[LAW_MOST_STATES];
  const double half = h / 2;
  int k;

  /* Slopes at the start, twice in the middle, and at the end. */
  law_derivative(p[0], x[0], v[0], z, k1);

  for (k = 0; k < count; ++k) {
    trial[k] = z[k] + half * k1[k];
  }
  law_derivative(p[1], x[1], v[1], trial, k2);

  for (k = 0; k < count; ++k) {
    trial[k] = z[k] + half * k2[k];
  }
  law_derivative(p[1], x[1], v[1], trial, k3);
  for (k = 0; k < count; ++k) {
    trial[k] = z[k] + h * k3[k];
  }
  law_derivative(p[2], x[2], v[2], trial, k4);
  for (k = 0; k < count; ++k) {
    z[k] += h / 6 * (k1[k] + 2 * (k2[k] + k3[k]) + k4[k]);
  }
}
