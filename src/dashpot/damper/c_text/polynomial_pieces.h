/* c[0] + c[1] s + c[2] s^2 + c[3] s^3 over s = 0 ... 1, as C99 text that the library takes in and
 * the C export ships. */

/* The polynomial at s. */
static inline double polynomial_at(const double* c, double s) {
  return c[0] + (s * (c[1] + (s * (c[2] + (s * c[3])))));
}

/* Through f[0] ... f[degree] on equal steps: Newton's form, multiplied out. */
static inline void polynomial_through(const double* f, int degree, double* c) {
  const double n = (double)degree, d1 = f[1] - f[0];
  c[0] = f[0];
  c[1] = d1;
  c[2] = 0;
  c[3] = 0;

  /* The divided differences d1, d2 and d3 as they are there for each degree. */
  if (degree == 2) {
    const double d2 = f[2] - (2 * f[1]) + f[0];
    c[1] = n * (d1 - (d2 / 2));
    c[2] = n * n * d2 / 2;
  }
  if (degree == 3) {
    const double d2 = f[2] - (2 * f[1]) + f[0], d3 = f[3] - (3 * f[2]) + (3 * f[1]) - f[0];
    c[1] = n * (d1 - (d2 / 2) + (d3 / 3));
    c[2] = n * n * (d2 - d3) / 2;
    c[3] = n * n * n * d3 / 6;
  }
}

/* The places within (0, 1) where the slope vanishes, between 0 and 1: increasing, at most four.
 * Returns how many. */
static inline int monotone_pieces(const double* c, double* places) {
  const double a = 3 * c[3], b = 2 * c[2], root = (b * b) - (4 * a * c[1]);
  int count = 1;
  places[0] = 0;
  if (root >= 0) {
    /* The form that loses no digits when a is small or 0. */
    const double q = -0.5 * (b + copysign(sqrt(root), b));
    const double first = c[1] / q, second = q / a;
    const double low = (second < first) ? second : first, high = (first < second) ? second : first;
    if ((low > 0) && (low < 1)) {
      places[count] = low;
      ++count;
    }
    if ((high > places[count - 1]) && (high < 1)) {
      places[count] = high;
      ++count;
    }
  }
  places[count] = 1;
  return count + 1;
}
