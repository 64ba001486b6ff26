/* x within low ... high */
static inline double held(double x, double low, double high) {
  double inside = x;
  if (x < low) {
    inside = low;
  } else if (x > high) {
    inside = high;
  } else {
    /* it is */
  }
  return inside;
}
