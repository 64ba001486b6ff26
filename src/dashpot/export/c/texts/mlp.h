/* A multilayer perceptron. Declared before: MLP_MOST_WIDTH, the most numbers in a layer. */
typedef struct Mlp {
  const int* layers; /* inputs, hidden ..., 1 */
  int layer_count;
  const int* activations; /* behind the inputs; 0 identity, 1 rectified linear, 2 tanh, 3 sigmoid */
  const double* parameters; /* layer after layer: a row of weights per neuron, then the biases */
  const double* input_mean; /* standardised = (raw - mean) / scale */
  const double* input_scale;
  double output_mean, output_scale; /* raw = mean + scale * standardised */
} Mlp;

static inline double mlp_activated(int kind, double sum) {
  double value = sum;
  if (kind == 1) {
    value = (sum < 0) ? 0 : sum;
  } else if (kind == 2) {
    value = tanh(sum);
  } else if (kind == 3) {
    value = 1 / (1 + exp(-sum));
  } else {
    /* the identity */
  }
  return value;
}

static inline void mlp_layer(const double* weights, int inputs, int outputs, const double* from,
                             double* to) {
  int n, i;
  for (n = 0; n < outputs; ++n) {
    double sum = weights[(inputs * outputs) + n];
    for (i = 0; i < inputs; ++i) {
      sum += weights[(n * inputs) + i] * from[i];
    }
    to[n] = sum;
  }
}

/* Output at one raw input, in raw units. */
static inline double mlp_evaluate(const Mlp* m, const double* raw) {
  double from[MLP_MOST_WIDTH], to[MLP_MOST_WIDTH];
  int layer, k, at = 0;

  /* Standardise, go from layer to layer, and back to raw units. */
  for (k = 0; k < m->layers[0]; ++k) {
    from[k] = (raw[k] - m->input_mean[k]) / m->input_scale[k];
  }
  for (layer = 1; layer < m->layer_count; ++layer) {
    const int inputs = m->layers[layer - 1], outputs = m->layers[layer];
    mlp_layer(&m->parameters[at], inputs, outputs, from, to);
    for (k = 0; k < outputs; ++k) {
      from[k] = mlp_activated(m->activations[layer - 1], to[k]);
    }
    at += (inputs + 1) * outputs;
  }
  return m->output_mean + (m->output_scale * from[0]);
}
