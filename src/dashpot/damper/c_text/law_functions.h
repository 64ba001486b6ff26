/* Functions of the equations of a law from a file beside those of math.h, as C99 text that the
 * library takes in and the C export ships.
 */
static inline double law_sign(double x) { return (double)((x > 0) - (x < 0)); }

/* base^exponent; the whole exponents that laws mostly have by products. */
static inline double law_power(double base, double exponent) {
  double value;
  if (exponent == 2) {
    value = base * base;
  } else if (exponent == 1) {
    value = base;
  } else if (exponent == 3) {
    value = base * base * base;
  } else {
    value = pow(base, exponent);
  }
  return value;
}
