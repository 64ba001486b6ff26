#include "dashpot/damper/nets/gated_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "dashpot/base/random.h"
#include "dashpot/damper/nets/tanh.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::size_t kMaxGates = 1 + GatedNetwork::kMaxCurrents +
                                  GatedNetwork::kMaxCurrents * (GatedNetwork::kMaxCurrents + 1) / 2;

/// Calls use(weights, tanh) for each neuron at the signals that it sees. Their tanhs are taken some
/// at a time.
template <class Use>
void for_neurons(const GatedNetwork& network, const double* held, Use use) {
  constexpr std::size_t kTogether = 8;
  const std::size_t count = network.signals.size(), stride = network.neuron_stride();
  std::array<double, kTogether> t;
  const double *w = network.neurons.data(), *end = w + network.neurons.size();
  while (w != end) {
    const std::size_t taken = std::min(kTogether, static_cast<std::size_t>(end - w) / stride);
    for (std::size_t k = 0; k < taken; ++k) {
      const double* weights = w + k * stride;
      t[k] = std::inner_product(weights, weights + count, held, weights[count]);
    }
    branchless_tanh(t.data(), taken);
    for (std::size_t k = 0; k < taken; ++k, w += stride) use(w, t[k]);
  }
}

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

void require_count(std::size_t count, std::size_t right, const std::string& what,
                   const std::string& where) {
  if (count != right)
    throw Error(where, "has " + std::to_string(count) + " " + what,
                "its states need " + std::to_string(right));
}

}  // namespace

void GatedNetwork::require_sound(std::size_t signal_count, const std::string& where) const {
  require_count(signals.size(), signal_count, "signals", where);
  for (const Signal& signal : signals) {
    if (!is_positive(signal.scale))
      throw Error(where, "the scale of a signal is not a positive number");
    if (!(signal.low <= signal.high))
      throw Error(where, "the range of a signal does not go upwards");
  }
  if (neurons.size() % neuron_stride() != 0)
    throw Error(where, "has " + std::to_string(neurons.size()) + " weights of neurons",
                "each neuron needs " + std::to_string(neuron_stride()));
  require_count(gates.size(), term_count() * gate_count(), "weights of gates", where);
  if (!is_positive(output_scale)) throw Error(where, "the output scale is not a positive number");
}

void GatedNetwork::fill_gates(const double* u, double* c) const noexcept {
  *c++ = 1;
  for (std::size_t m = 0; m < currents; ++m) *c++ = u[m];
  for (std::size_t m = 0; m < currents; ++m)
    for (std::size_t n = 0; n <= m; ++n) *c++ = u[m] * u[n];
}

double GatedNetwork::evaluate(const double* raw) const noexcept {
  std::array<double, kMaxSignals> linear, held;
  standardise(raw, linear.data());
  hold(linear.data(), held.data());
  return output_scale * sum(linear.data(), held.data());
}

double GatedNetwork::evaluate_held(const double* raw) const noexcept {
  std::array<double, kMaxSignals> linear, held;
  standardise(raw, linear.data());
  hold(linear.data(), held.data());
  return output_scale * sum(held.data(), held.data());
}

/// The velocity among the terms: beyond its range it goes on where that takes energy out.
double GatedNetwork::continued(double linear, double held, double gain) noexcept {
  return gain > 0 ? linear : held;
}

/// held: what gates, neurons and the terms see; linear: where the velocity goes on to.
double GatedNetwork::sum(const double* linear, const double* held) const noexcept {
  std::array<double, kMaxGates> c;
  fill_gates(&held[motions()], c.data());
  const std::size_t count = gate_count();
  const double* gate = gates.data();
  double sum = 0;

  // Each term of t is gated: multiplied by its own polynomial of the currents.
  const auto next_gain = [&] {
    const double gain = std::inner_product(gate, gate + count, c.begin(), 0.0);
    gate += count;
    return gain;
  };
  const auto add = [&](double term) { sum += term * next_gain(); };

  // The constant, the motions, then the neurons, in the order of the rows of G.
  add(1);
  const double of_velocity = next_gain();
  sum += continued(linear[0], held[0], of_velocity) * of_velocity;
  for (std::size_t k = 1; k < motions(); ++k) add(held[k]);
  for_neurons(*this, held, [&](const double*, double t) { add(t); });
  return sum;
}

double GatedNetwork::differentiate(const double* linear, const double* held, double* by_parameters,
                                   double* by_signals) const noexcept {
  const std::size_t count = signals.size(), first_current = motions(), width = gate_count();
  const double* u = held + first_current;

  std::array<double, kMaxGates> c, by_c{};
  fill_gates(u, c.data());
  std::fill_n(by_signals, count, 0.0);

  // Each gated term: its part of the output, the derivatives by its row of G, and what it adds to
  // the derivatives by the gates c. Returns the derivative of the output by the term.
  const double* gate = gates.data();
  double* by_gate = by_parameters + neurons.size();
  double sum = 0;
  const auto gain_of_next = [&] { return std::inner_product(gate, gate + width, c.begin(), 0.0); };
  const auto add = [&](double term) {
    const double gain = gain_of_next();
    for (std::size_t k = 0; k < width; ++k) {
      by_c[k] += term * *gate++;
      *by_gate++ = term * c[k];
    }
    sum += term * gain;
    return gain;
  };

  // The constant, the velocity, which may go on beyond its range, and the other motions.
  add(1);
  const double of_velocity = gain_of_next();
  add(continued(linear[0], held[0], of_velocity));
  if (held[0] == linear[0] || of_velocity > 0) by_signals[0] += of_velocity;
  for (std::size_t k = 1; k < first_current; ++k) {
    const double gain = add(held[k]);
    if (held[k] == linear[k]) by_signals[k] += gain;
  }

  // Neurons: on through tanh to their weights and to the signals, but for those at the end of their
  // range.
  for_neurons(*this, held, [&](const double* w, double t) {
    const double delta = add(t) * (1 - t * t);
    for (std::size_t k = 0; k < count; ++k) {
      *by_parameters++ = delta * held[k];
      if (held[k] == linear[k]) by_signals[k] += delta * w[k];
    }
    *by_parameters++ = delta;
  });

  // From the gates to the currents that they are products of.
  const double *by_current = &by_c[1], *by_product = &by_c[1 + currents];
  for (std::size_t m = 0; m < currents; ++m) {
    by_signals[first_current + m] += *by_current++;
    for (std::size_t n = 0; n <= m; ++n, ++by_product) {
      by_signals[first_current + m] += *by_product * u[n];
      by_signals[first_current + n] += *by_product * u[m];
    }
  }
  for (std::size_t k = first_current; k < count; ++k)
    if (held[k] != linear[k]) by_signals[k] = 0;
  return sum;
}

void GatedNetwork::initialise(std::size_t hidden_neurons, std::uint64_t seed) {
  Random random(seed);
  const double reach = 1 / std::sqrt(static_cast<double>(signals.size()));
  neurons.resize(hidden_neurons * neuron_stride());
  for (double& weight : neurons) weight = random.normal() * reach;
  gates.assign(term_count() * gate_count(), 0.0);
}

}  // namespace dashpot
