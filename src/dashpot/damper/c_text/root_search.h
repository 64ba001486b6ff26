/* Where a function crosses zero, as C99 text that the library takes in and the C export ships.
 * Declared before: RootError, root_error(f, place), and ROOT_NARROW: as near as numbers come, of a
 * bracket's width.
 */

/* A function's values at two places. */
typedef struct RootBracket {
  double low, high;
  double f_low, f_high;
} RootBracket;

/* Whether f changes its sign between the two places, where both values are numbers. */
static inline int bracket_holds(const RootBracket* b) {
  return ((b->f_low <= 0) != (b->f_high <= 0)) && (isnan(b->f_low + b->f_high) == 0);
}

/* The place where f crosses zero in a bracket that holds a crossing: secants that keep the bracket
 * (Illinois), halving it where they gain little. Right for a jump, too. At most 60 steps. */
static inline double root_crossing(const RootError* f, const RootBracket* bracket,
                                   double tolerance) {
  RootBracket b = *bracket;
  const double enough = tolerance * fabs(b.f_high - b.f_low),
               narrow = ROOT_NARROW * (b.high - b.low);
  double x = b.low;
  int kept = 0, found = 0, k; /* kept: -1, the low end was, by the last step; 1: the high end */

  for (k = 0; (k < 60) && (found == 0); ++k) {
    /* Try where the secant crosses; every eighth time the middle, so that the bracket shrinks. */
    const double share = b.f_low / (b.f_low - b.f_high);
    const int halve = ((k % 8) == 7) || !((share > 0) && (share < 1));
    double f_x;
    x = (halve != 0) ? (0.5 * (b.low + b.high)) : (b.low + (share * (b.high - b.low)));
    f_x = root_error(f, x);

    /* Near enough, or f is not a number: done. Else the new place replaces the end of its own side.
     * An end that stays twice counts half (Illinois). */
    if (!(fabs(f_x) > enough) || ((b.high - b.low) <= narrow)) {
      found = 1;
    } else if ((f_x <= 0) == (b.f_low <= 0)) {
      b.low = x;
      b.f_low = f_x;
      b.f_high *= (kept == 1) ? 0.5 : 1;
      kept = 1;
    } else {
      b.high = x;
      b.f_high = f_x;
      b.f_low *= (kept == -1) ? 0.5 : 1;
      kept = -1;
    }
  }
  return (found != 0) ? x : (0.5 * (b.low + b.high));
}

/* The result of a search along increasing places. */
typedef struct FirstRoot {
  double place;     /* of the first crossing, or else where |f| is least */
  int crosses;      /* f crosses zero there */
  int rises;        /* ... upwards */
  double variation; /* greatest less least f, where nothing crosses */
} FirstRoot;

/* The first crossing between neighbours of `places` (increasing, at least two), or where f comes
 * nearest to zero. */
static inline FirstRoot first_root(const RootError* f, const double* places, int count,
                                   double tolerance) {
  FirstRoot found = {0, 0, 0, 0};
  double nearest, least, greatest;
  RootBracket b;
  int k;

  /* The first place is the nearest so far. */
  b.low = places[0];
  b.high = places[0];
  b.f_low = root_error(f, places[0]);
  b.f_high = 0;
  nearest = fabs(b.f_low);
  least = b.f_low;
  greatest = b.f_low;
  found.place = places[0];

  /* Go on from place to place until two hold a crossing between them. */
  for (k = 1; (k < count) && (found.crosses == 0); ++k) {
    b.high = places[k];
    b.f_high = root_error(f, b.high);
    if (bracket_holds(&b) != 0) {
      found.crosses = 1;
      found.rises = b.f_high > b.f_low;
    } else {
      if (fabs(b.f_high) < nearest) {
        nearest = fabs(b.f_high);
        found.place = b.high;
      }
      b.low = b.high;
      b.f_low = b.f_high;
    }
    least = fmin(least, b.f_high);
    greatest = fmax(greatest, b.f_high);
  }

  if (found.crosses != 0) {
    found.place = root_crossing(f, &b, tolerance);
  }
  found.variation = greatest - least;
  return found;
}
