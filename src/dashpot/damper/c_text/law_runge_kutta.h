/* A step that laws are integrated by, as C99 text that the library takes in once per law and the C export
 * ships. Declared before: LawParameters, law_derivative and LAW_MOST_STATES.
 */

static inline void law_move(const double* z, const double* dz, double h, int count, double* moved) {
  int k;
  for (k = 0; k < count; ++k) {
    moved[k] = z[k] + h * dz[k];
  }
}

/* One classical Runge-Kutta step of length h, with p, x and v at its start, middle and end. */
static inline void law_runge_kutta(const LawParameters* const* p, const double* x, const double* v, double h,
                                   int count, double* z) {
  double k1[LAW_MOST_STATES] = {0}, k2[LAW_MOST_STATES] = {0}, k3[LAW_MOST_STATES] = {0};
  double k4[LAW_MOST_STATES] = {0}, trial[LAW_MOST_STATES];
  int k;
  law_derivative(p[0], x[0], v[0], z, k1);
  law_move(z, k1, h / 2, count, trial);
  law_derivative(p[1], x[1], v[1], trial, k2);
  law_move(z, k2, h / 2, count, trial);
  law_derivative(p[1], x[1], v[1], trial, k3);
  law_move(z, k3, h, count, trial);
  law_derivative(p[2], x[2], v[2], trial, k4);
  for (k = 0; k < count; ++k) {
    z[k] += h / 6 * (k1[k] + 2 * (k2[k] + k3[k]) + k4[k]);
  }
}
