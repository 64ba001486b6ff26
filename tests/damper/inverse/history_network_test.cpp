#include "dashpot/damper/inverse/history_network.h"

#include <limits>

#include "damper/inverse/example_network.h"
#include "support.h"

using namespace dashpot;

namespace {

using enum Tap::Signal;

/// i = bias + sum of weight * tap: a network without a hidden layer, so that every answer is known.
InverseNetwork linear(std::vector<Tap> taps, std::vector<double> weights, double bias) {
  InverseNetwork network{.name = "linear", .taps = std::move(taps), .spacing = 2e-3, .mlp = {}};
  network.current_max = 10;
  network.mlp.layers = {network.taps.size(), 1};
  network.mlp.parameters = std::move(weights);
  network.mlp.parameters.push_back(bias);
  network.mlp.input_mean.assign(network.taps.size(), 0.0);
  network.mlp.input_scale.assign(network.taps.size(), 1.0);
  return network;
}

constexpr InverseLimits kLimits{.current_max = 10};  // 1 ms

std::vector<double> commands(const HistoryNetwork& inverse,
                             const std::vector<InverseInput>& inputs) {
  std::vector<double> state(inverse.state_size()), answers;
  inverse.rest({}, state);
  for (const InverseInput& input : inputs) answers.push_back(inverse.command(input, state));
  return answers;
}

}  // namespace

TEST_CASE("inverse network: each tap reads its own signal, so many steps ago") {
  const HistoryNetwork inverse(
      linear({{Displacement, 0}, {Velocity, 1}, {Force, 2}}, {1, 10, 100}, 0), kLimits);
  // Steps of 2 ms at commands each 1 ms: v is seen 2 commands later, the force 4 commands later.
  const std::vector<double> answers = commands(
      inverse, {{.wanted = 0.03, .displacement = 0.5, .velocity = 0.2}, {}, {}, {}, {}, {}});
  const double expected[] = {0.5, 0, 2, 0, 3, 0};
  for (std::size_t k = 0; k < answers.size(); ++k) CHECK_CLOSE(answers[k], expected[k], 0, 1e-12);
}

TEST_CASE("inverse network: it feeds back its own answer, not the coil's current") {
  const HistoryNetwork inverse(linear({{Current, 1}, {Force, 0}}, {0.5, 1}, 0), kLimits);
  const std::vector<double> answers = commands(
      inverse, {{.wanted = 4, .current = 9}, {.current = 9}, {.current = 9}, {}, {.current = 9}});
  const double expected[] = {4, 0, 2, 0, 1};
  for (std::size_t k = 0; k < answers.size(); ++k) CHECK_CLOSE(answers[k], expected[k], 0, 1e-12);
}

TEST_CASE("inverse network: within the limits and what it was taught; its rate only where asked") {
  InverseNetwork network = linear({{Force, 0}}, {1}, 0);
  network.current_min = 1;
  network.current_max = 8;
  CHECK(commands(HistoryNetwork(network, kLimits), {{.wanted = -5}, {.wanted = 99}}) ==
        std::vector<double>{1, 8});
  CHECK(commands(HistoryNetwork(network, {.current_max = 5}), {{.wanted = 99}}).front() == 5);
  network.rate_max = 500;  // A/s: half an ampere per command, from the least current on
  const std::vector<double> limited =
      commands(HistoryNetwork(network, kLimits), {{.wanted = 9}, {.wanted = 9}});
  CHECK_CLOSE(limited[0], 1.5, 0, 1e-12);
  CHECK_CLOSE(limited[1], 2, 0, 1e-12);
}

TEST_CASE("inverse network: what overflows gives the least current, and is forgotten in time") {
  constexpr double kHuge = std::numeric_limits<double>::max();
  InverseNetwork network = linear({{Force, 0}, {Velocity, 0}}, {3, -3}, 0);
  const std::vector<double> answers = commands(
      HistoryNetwork(network, kLimits), {{.wanted = kHuge, .velocity = kHuge}, {.wanted = 1}});
  CHECK(answers[0] == 0);  // infinity less infinity
  CHECK_CLOSE(answers[1], 3, 0, 1e-12);
}

TEST_CASE("inverse network: what cannot work is refused") {
  const auto message = [](InverseNetwork network, InverseLimits limits = kLimits) {
    return message_of([&] { HistoryNetwork(std::move(network), limits); });
  };
  const InverseNetwork good = linear({{Force, 0}}, {1}, 0);
  CHECK(message(good).empty());
  CHECK(message(good, {.sample_time = 1.5e-3}).find("steps of 2 ms; take a sample time") !=
        std::string::npos);
  CHECK(message(good, {.sample_time = 4e-3}).find("steps of 2 ms") != std::string::npos);
  CHECK(message(good, {.current_max = 10, .sample_time = 1.0 / 3004.8}).empty());  // 6.01 samples
  CHECK(message(good, {.current_min = 11, .current_max = 12}).find("none of which") !=
        std::string::npos);
  CHECK(
      message(linear({{Current, 0}}, {1}, 0)).find("a delay of 0 steps of the current; 1 to 100") !=
      std::string::npos);
  CHECK(message(linear({{Force, 101}}, {1}, 0)).find("a delay of 101 steps") != std::string::npos);
  CHECK(message(linear({{Force, 0}}, {1, 2}, 0)).find("weights") != std::string::npos);
  InverseNetwork bad = good;
  bad.spacing = 0;
  CHECK(message(bad).find("its step is not between") != std::string::npos);
  bad = good;
  bad.current_min = 10;
  CHECK(message(bad).find("no range") != std::string::npos);
  bad = good;
  bad.rate_max = -1;
  CHECK(message(bad).find("rate limit is below 0") != std::string::npos);
}
