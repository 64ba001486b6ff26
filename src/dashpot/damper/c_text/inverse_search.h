/* The inverse of any model by search, as C99 text that the library takes in and the C export ships.
 * Declared before: what inverse_observer.h defines, and root_search.h with RootError as
 * SearchError.
 */

/* The numbers of the search itself, beside the observer's. */
typedef struct SearchNumbers {
  double least, most; /* currents */
  double negligible;  /* N, less than which no current changes anything */
} SearchNumbers;

#define SEARCH_CELLS 8        /* of the current range, each searched for a crossing */
#define SEARCH_TOLERANCE 1e-5 /* of the force's change over a bracket */

/* The least current that gives the force; where none does, the one that comes nearest; where
 * current has no effect, the present one. own: the last solution, and +1 or -1 as its error rose or
 * fell with current, 0 where there was none. */
static inline double search_wanted(const Observer* m, const SearchNumbers* p,
                                   const InverseInput* input, double* state, double* own) {
  const double range = p->most - p->least;
  double answer = input->current;
  int done = 0, k;
  SearchError error;
  observer_follow(m, input, state);
  error.observer = m;
  error.input = input;
  error.state = state;
  /* Beside the last solution first, on the same side of a force that rises and falls with current.
   */
  if (own[1] != 0) {
    RootBracket beside;
    beside.low = fmax(p->least, own[0] - (range / (2 * SEARCH_CELLS)));
    beside.high = fmin(p->most, own[0] + (range / (2 * SEARCH_CELLS)));
    beside.f_low = root_error(&error, beside.low);
    beside.f_high = root_error(&error, beside.high);
    if ((bracket_holds(&beside) != 0) && ((beside.f_high > beside.f_low) == (own[1] > 0))) {
      answer = root_crossing(&error, &beside, SEARCH_TOLERANCE);
      own[0] = answer;
      done = 1;
    }
  }

  /* Else over the whole range: the first of its parts in which the force is met. own[1] keeps the
   * side for the next search. */
  if (done == 0) {
    double places[SEARCH_CELLS + 1];
    FirstRoot found;
    for (k = 0; k <= SEARCH_CELLS; ++k) {
      places[k] = (k < SEARCH_CELLS) ? (p->least + (range * (double)k / SEARCH_CELLS)) : p->most;
    }
    found = first_root(&error, places, SEARCH_CELLS + 1, SEARCH_TOLERANCE);
    own[1] = 0;
    if (found.crosses != 0) {
      own[1] = (found.rises != 0) ? 1 : -1;
    }
    if ((found.crosses != 0) || (found.variation > p->negligible)) {
      answer = found.place;
      own[0] = answer;
    }
  }
  return answer;
}
