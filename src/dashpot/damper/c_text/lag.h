/* A first-order lag y' = rate (u - y) after a step over which u goes linearly from u0 to u1; turn =
 * rate * step. Exact, and written so that little is lost in single precision where the turn is
 * small. */
static inline double lag_after(double y, double u0, double u1, double turn) {
  const double gone = -expm1(-turn);
  return y + (gone * (u0 - y)) + ((1 - (gone / turn)) * (u1 - u0));
}
