/* The inverse in closed form where the force is a polynomial of the current, as C99 text that the
 * library takes in and the C export ships. Declared before: what inverse_observer.h and
 * polynomial_pieces.h define, root_search.h with RootError as PolynomialError, and ROOT_TOLERANCE.
 */

/* The numbers of the inverse itself, beside the observer's. */
typedef struct PolynomialNumbers {
  int degree;
  double least, most; /* currents */
  double negligible;  /* N, less than which no current changes anything */
} PolynomialNumbers;

/* c: the force over s = 0 ... 1, from the least current to the most, through degree + 1 currents */
static inline void polynomial_force(const Observer* m, const PolynomialNumbers* p,
                                    const InverseInput* input, double* state, double* c) {
  double f[4] = {0, 0, 0, 0};
  int k;
  for (k = 0; k <= p->degree; ++k) {
    f[k] = observer_force(m, p->least + ((p->most - p->least) * (double)k / (double)p->degree),
                          input, state);
  }
  polynomial_through(f, p->degree, c);
}

/* The current that gives the wanted force: the least of several; where none does, the one that
 * comes nearest; where current has no effect, the present one. */
static inline double polynomial_wanted(const Observer* m, const PolynomialNumbers* p,
                                       const InverseInput* input, double* state) {
  PolynomialError error;
  double places[4];
  FirstRoot found;

  observer_follow(m, input, state);
  polynomial_force(m, p, input, state, error.c);
  error.wanted = input->wanted;
  found = first_root(&error, places, monotone_pieces(error.c, places), ROOT_TOLERANCE);
  return ((found.crosses == 0) && (found.variation <= p->negligible))
             ? input->current
             : (p->least + (found.place * (p->most - p->least)));
}
