#include "held.h"

/* F = sum_j (sum_k G_jk c_k(u)) t_j with t = [1, z, tanh(W [z, u] + b)] and c = [1, u_m, u_m u_n]:
 * motions z, then currents u. Declared before: GATED_MOST_SIGNALS, GATED_MOST_GATES. */
typedef struct GatedNetwork {
  int signals, currents, hidden;
  const double* mean; /* standardised = (raw - mean) / scale, held within low ... high */
  const double* scale;
  const double* low;
  const double* high;
  const double* neurons; /* per neuron: weights of the signals, then b */
  const double* gates;   /* G, row by row */
  double output_scale;
} GatedNetwork;

/* Fills c; returns how many numbers it has. */
static inline int gated_fill(const GatedNetwork* n, const double* u, double* c) {
  int m, k, count = 1;
  c[0] = 1;
  for (m = 0; m < n->currents; ++m) {
    c[count] = u[m];
    ++count;
  }
  for (m = 0; m < n->currents; ++m) {
    for (k = 0; k <= m; ++k) {
      c[count] = u[m] * u[k];
      ++count;
    }
  }
  return count;
}

static inline double gated_sum(const double* weights, const double* values, int count) {
  double sum = 0;
  int k;
  for (k = 0; k < count; ++k) {
    sum += weights[k] * values[k];
  }
  return sum;
}

/* Output at raw signals, held within what was seen in training. Unless `hold`, the velocity (the
 * first of the motions) goes on along its straight line where that takes energy out. */
static inline double gated_evaluate(const GatedNetwork* n, const double* raw, int hold) {
  const int motions = n->signals - n->currents;
  double inside[GATED_MOST_SIGNALS], c[GATED_MOST_GATES], velocity, gain, sum;
  int k, gates, row = 1;

  /* Standardise, and hold within what was seen in training. */
  for (k = 0; k < n->signals; ++k) {
    inside[k] = held((raw[k] - n->mean[k]) / n->scale[k], n->low[k], n->high[k]);
  }

  /* The constant, the motions and the neurons, each times its gate: a polynomial of the currents.
   */
  gates = gated_fill(n, &inside[motions], c);
  sum = gated_sum(n->gates, c, gates);
  velocity = (raw[0] - n->mean[0]) / n->scale[0];
  for (k = 0; k < motions; ++k) {
    gain = gated_sum(&n->gates[row * gates], c, gates);
    sum += (((k == 0) && (hold == 0) && (gain > 0)) ? velocity : inside[k]) * gain;
    ++row;
  }
  for (k = 0; k < n->hidden; ++k) {
    const double* w = &n->neurons[k * (n->signals + 1)];
    sum += tanh(gated_sum(w, inside, n->signals) + w[n->signals]) *
           gated_sum(&n->gates[row * gates], c, gates);
    ++row;
  }
  return n->output_scale * sum;
}
