/* x within low ... high */
static inline double held(double x, double low, double high) { return fmin(fmax(x, low), high); }
