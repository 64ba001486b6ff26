#include "dashpot/damper/nets/gated_network.h"

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Three motions, two currents, four neurons, random weights.
GatedNetwork random_network() {
  GatedNetwork network;
  network.signals = {{0, 2, -3, 3}, {0, 1, -3, 3}, {0, 0.5, -3, 3}, {1, 1, -1, 1}, {1, 1, -1, 1}};
  network.currents = 2;
  network.initialise(4, 3);
  Random random(5);
  for (double& weight : network.gates) weight = random.normal();
  network.output_scale = 100;
  return network;
}

}  // namespace

TEST_CASE("one neuron by hand") {
  GatedNetwork network;
  network.signals = {{0, 2, -3, 3}, {1, 0.5, -2, 2}};
  network.currents = 1;
  network.neurons = {0.7, -0.4, 0.1};
  network.gates = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  network.output_scale = 10;
  const double v[] = {0.6, 1.2};
  const double z = 0.3, u = 0.4, t = std::tanh(0.7 * z - 0.4 * u + 0.1);
  const auto gate = [&](double a, double b, double c) { return a + b * u + c * u * u; };
  CHECK(network.parameter_count() == 12);
  CHECK_CLOSE(network.evaluate(v), 10 * (gate(1, 2, 3) + gate(4, 5, 6) * z + gate(7, 8, 9) * t),
              1e-14, 0);
}

TEST_CASE("derivatives are those of the output") {
  GatedNetwork network = random_network();
  std::vector<double> z{0.3, -0.8, 1.1, 0.4, -0.6};
  std::vector<double> by_parameters(network.parameter_count()), by_signals(z.size()),
      none_p(by_parameters), none_s(by_signals);
  const auto output = [&] { return network.differentiate(z.data(), none_p.data(), none_s.data()); };
  const auto slope = [&](double& at) {
    const double here = at, step = 1e-5;
    at = here + step;
    const double above = output();
    at = here - step;
    const double below = output();
    at = here;
    return (above - below) / (2 * step);
  };
  const double value = network.differentiate(z.data(), by_parameters.data(), by_signals.data());
  const std::vector<double> raw{0.6, -0.8, 0.55, 1.4, 0.4};
  CHECK_CLOSE(network.evaluate(raw.data()), 100 * value, 1e-13, 0);
  std::size_t k = 0;
  for (double& weight : network.neurons) CHECK_CLOSE(by_parameters[k++], slope(weight), 1e-7, 1e-8);
  for (double& weight : network.gates) CHECK_CLOSE(by_parameters[k++], slope(weight), 1e-7, 1e-8);
  for (std::size_t i = 0; i < z.size(); ++i) CHECK_CLOSE(by_signals[i], slope(z[i]), 1e-7, 1e-8);
}

TEST_CASE("beyond the data the current stays at its edge and the motion goes on along a line") {
  const GatedNetwork network = random_network();
  const auto force = [&](double v, double u) {
    const std::vector<double> raw{v, 0.1, 0.2, u, 1};
    return network.evaluate(raw.data());
  };
  CHECK(force(0.3, 50) == force(0.3, 2));
  CHECK_CLOSE(force(30, 1) - force(20, 1), force(20, 1) - force(10, 1), 1e-12, 0);
}

TEST_CASE("without biases and constant row, and the current out of the neurons, the force is odd") {
  GatedNetwork network = random_network();
  for (std::size_t h = 0; h < network.hidden(); ++h)
    for (std::size_t k = network.motions(); k < network.neuron_stride(); ++k)
      network.neurons[h * network.neuron_stride() + k] = 0;
  std::fill_n(network.gates.begin(), network.gate_count(), 0.0);
  const std::vector<double> one{0.6, -0.8, 0.55, 1.4, 0.4}, other{-0.6, 0.8, -0.55, 1.4, 0.4};
  CHECK(network.evaluate(one.data()) != 0);
  CHECK(network.evaluate(one.data()) == -network.evaluate(other.data()));
}
