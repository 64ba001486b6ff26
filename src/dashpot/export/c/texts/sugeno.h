#include "held.h"

/* Takagi-Sugeno inference of first order: rules that are linear functions of the inputs, weighted
 * by how far each holds. Declared before: SUGENO_MOST_INPUTS, SUGENO_MOST_MEMBERSHIPS,
 * SUGENO_MOST_RULES. */
typedef struct Membership {
  int shape; /* 0 bell, 1 Gaussian, 2 sigmoid */
  int input;
  double centre, width, slope;
} Membership;

typedef struct Sugeno {
  int inputs;
  const double* mean; /* standardised = (raw - mean) / scale, seen held within low ... high */
  const double* scale;
  const double* low;
  const double* high;
  const Membership* memberships;
  int membership_count;
  const int* rules; /* rule after rule: how many memberships, then which */
  int rule_count;
  const double* consequents; /* rule after rule: a slope per input, then the constant */
  double output_mean, output_scale;
} Sugeno;

/* The logarithm of how far x belongs to the set. */
static inline double membership_log(const Membership* m, double x) {
  const double most_exponent = 80;
  const double u = (x - m->centre) / m->width;
  double value;
  if (m->shape == 1) {
    value = -fmin(0.5 * u * u, most_exponent);
  } else {
    const double e = (m->shape == 0) ? (m->slope * log(u * u)) : (-m->slope * (x - m->centre));
    value = -log1p(exp(fmin(e, most_exponent)));
  }
  return value;
}

/* For each rule the logarithm of how far all its memberships hold; returns the greatest. */
static inline double sugeno_hold(const Sugeno* s, const double* memberships, double* rules) {
  double most = 0;
  int k, r, at = 0;
  for (r = 0; r < s->rule_count; ++r) {
    rules[r] = 0;
    for (k = 1; k <= s->rules[at]; ++k) {
      rules[r] += memberships[s->rules[at + k]];
    }
    at += s->rules[at] + 1;
    most = (r == 0) ? rules[r] : fmax(most, rules[r]);
  }
  return most;
}

/* Output at one raw input, in raw units. */
static inline double sugeno_evaluate(const Sugeno* s, const double* raw) {
  double linear[SUGENO_MOST_INPUTS], memberships[SUGENO_MOST_MEMBERSHIPS], rules[SUGENO_MOST_RULES];
  double weighted = 0, weights = 0, most;
  int k, r;

  /* Memberships of the inputs, held within what was seen in training; then of the rules. */
  for (k = 0; k < s->inputs; ++k) {
    linear[k] = (raw[k] - s->mean[k]) / s->scale[k];
  }
  for (k = 0; k < s->membership_count; ++k) {
    const Membership* m = &s->memberships[k];
    memberships[k] = membership_log(m, held(linear[m->input], s->low[m->input], s->high[m->input]));
  }
  most = sugeno_hold(s, memberships, rules);

  /* The mean of the rules' outputs, weighted beside the strongest, so that no weight underflows. */
  for (r = 0; r < s->rule_count; ++r) {
    const double* slopes = &s->consequents[r * (s->inputs + 1)];
    const double weight = exp(rules[r] - most);
    double rule = slopes[s->inputs];
    for (k = 0; k < s->inputs; ++k) {
      rule += slopes[k] * linear[k];
    }
    weights += weight;
    weighted += weight * rule;
  }
  return s->output_mean + (s->output_scale * (weighted / weights));
}
