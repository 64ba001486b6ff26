#include "dashpot/damper/nets/gated_network.h"

#include <algorithm>
#include <cmath>

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

TEST_CASE("derivatives beyond the data are those of what is held and of what goes on") {
  GatedNetwork network = random_network();
  for (const double gain : {0.8, -0.8}) {
    CAPTURE(gain);
    double* const row = &network.gates[network.gate_count()];
    std::fill_n(row, network.gate_count(), 0.0);
    *row = gain;

    // Velocity and one motion beyond their ranges, a current as well.
    std::vector<double> z{4.3, -3.8, 1.1, 0.4, -1.6}, held(z.size());
    std::vector<double> by_parameters(network.parameter_count()), by_signals(z.size());
    const auto output = [&] {
      network.hold(z.data(), held.data());
      return network.output(z.data(), held.data());
    };
    const auto slope = [&](double& at) {
      const double here = at, step = 1e-5;
      at = here + step;
      const double above = output();
      at = here - step;
      const double below = output();
      at = here;
      return (above - below) / (2 * step);
    };
    const double value = output();
    CHECK(value ==
          network.differentiate(z.data(), held.data(), by_parameters.data(), by_signals.data()));
    std::size_t k = 0;
    for (double& weight : network.neurons)
      CHECK_CLOSE(by_parameters[k++], slope(weight), 1e-7, 1e-8);
    for (double& weight : network.gates) CHECK_CLOSE(by_parameters[k++], slope(weight), 1e-7, 1e-8);
    for (std::size_t i = 0; i < z.size(); ++i) CHECK_CLOSE(by_signals[i], slope(z[i]), 1e-7, 1e-8);
    CHECK(by_signals[0] == std::max(gain, 0.0));
    CHECK(by_signals[1] == 0);
    CHECK(by_signals[4] == 0);
  }
}

TEST_CASE("beyond the data all is held but a velocity that takes energy out, which goes on") {
  GatedNetwork network = random_network();
  const auto force = [&](double v, double lag, double u) {
    const std::vector<double> raw{v, lag, 0.2, u, 1};
    return network.evaluate(raw.data());
  };
  CHECK(force(0.3, 0.1, 50) == force(0.3, 0.1, 2));
  CHECK(force(0.3, 50, 1) == force(0.3, 3, 1));

  // At u = 1 the standardised currents are 0, so the gain is the first weight of its row.
  double& gain = network.gates[network.gate_count()];
  gain = 0.5;
  CHECK_CLOSE(force(30, 0.1, 1) - force(20, 0.1, 1), 100 * 0.5 * 10 / 2, 1e-12, 0);
  gain = -0.5;
  CHECK(force(30, 0.1, 1) == force(6, 0.1, 1));
}

TEST_CASE("whatever its weights, beyond its data a network is a bounded force beside a dashpot") {
  Random random(3);
  for (int n = 0; n < 200; ++n) {
    GatedNetwork network = random_network();
    for (double& weight : network.neurons) weight = 3 * random.normal();
    for (double& weight : network.gates) weight = 10 * random.normal();
    double bound = 0;  // held motions are within 3, currents and neurons within 1
    for (const double weight : network.gates) bound += 3 * 100 * std::abs(weight);

    for (int k = 0; k < 100; ++k) {
      std::vector<double> raw(network.signals.size());
      for (double& value : raw) value = random.normal() * std::pow(10, random.uniform(-2, 6));
      const double held = network.evaluate_held(raw.data());
      CHECK(std::abs(held) <= bound);
      CHECK((network.evaluate(raw.data()) - held) * raw[0] >= 0);
    }
  }
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
