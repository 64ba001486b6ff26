#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "damper/kinds/passive_network/passive_network_example.h"
#include "dashpot/damper/kinds/passive_network/energy_balance.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A motion whose displacement is the integral of its velocity, under a current that leaps.
class Shaken {
 public:
  Shaken(std::uint64_t seed, double step) : random_(seed), step_(step) {}
  DamperInput next(const DamperInput& from) {
    DamperInput to = from;
    to.velocity = 0.98 * from.velocity + 0.05 * random_.normal();
    to.displacement += step_ * (from.velocity + to.velocity) / 2;
    if (random_.uniform() < 0.02) to.current = 2 * random_.uniform();
    return to;
  }

 private:
  Random random_;
  double step_;
};

/// What a network gave beyond what it had taken in, J, at the worst instant of a random run, and
/// the work that was done on it, J; the work by the trapezoidal rule.
struct Balance {
  double worst = -INFINITY, work = 0;
};
Balance balance(const PassiveNetwork& network, std::uint64_t seed, double step, int samples) {
  Shaken shaken(seed, step);
  DamperInput now;
  std::vector<double> state(network.size());
  network.rest(now, state);
  const double begin = network.stored_energy(now, state);
  Balance result;
  double net = 0;
  for (int k = 0; k < samples; ++k) {
    const DamperInput next = shaken.next(now);
    const double before = network.force(now, state) * now.velocity;
    network.advance(now, next, step, state);
    const double power = (before + network.force(next, state) * next.velocity) / 2;
    net += power * step;
    result.work += std::abs(power) * step;
    now = next;
    result.worst = std::max(result.worst, network.stored_energy(now, state) - begin - net);
  }
  return result;
}

int random_networks() {
  const char* asked = std::getenv("DASHPOT_PASSIVE_NETWORKS");
  return asked ? std::atoi(asked) : 500;
}

}  // namespace

TEST_CASE("whatever its numbers, a passive network gives back no more than it took in") {
  Random random(7);
  for (int k = 0; k < random_networks(); ++k) {
    // Networks from tame to wild; steps so short that the rule which sums the work is exact.
    const double spread = 3 * random.uniform(), step = 1e-6 * std::pow(10, 1.5 * random.uniform());
    const PassiveNetwork network = example_passive_network(random.next(), spread);
    const Balance found = balance(network, random.next(), step, 400);
    CAPTURE(k);
    CHECK(found.worst <= 1e-4 * found.work + 1e-12);
  }
}

TEST_CASE("the check finds a network that does generate energy") {
  PassiveNetwork network = example_passive_network(3, 0.5);
  const PassiveLayout at(network.sizes);
  network.numbers[at.inertia] = -20;
  CHECK(balance(network, 5, 1e-5, 400).worst > 1e-3 * balance(network, 5, 1e-5, 400).work);
}

TEST_CASE("a file with a number that would generate energy is refused") {
  for (const bool spring : {false, true}) {
    PassiveNetwork network = example_passive_network();
    const PassiveLayout at(network.sizes);
    network.numbers[spring ? at.stiffness : at.levers + 1] = -0.1;
    const std::string message =
        message_of([&] { PassiveNetworkModel("passive_network", {network}); });
    CHECK(message.find("never negative: the network would generate energy") != std::string::npos);
  }
}

TEST_CASE("a passive network is a model file, to the bit") {
  const PassiveNetworkModel model("passive_network",
                                  {example_passive_network(1), example_passive_network(2)}, 3);
  const auto again = passive_network_model_from_json(model.to_json());
  CHECK(format_json(again->to_json()) == format_json(model.to_json()));
  CHECK(again->state_size() == model.state_size());
}

TEST_CASE("a passive network of an earlier Dashpot is refused with what to do") {
  const PassiveNetworkModel model("passive_network", {example_passive_network()});
  std::string text = format_json(model.to_json());
  const std::size_t at = text.find("\"drive_fade\"");
  REQUIRE(at != std::string::npos);
  text.erase(at, text.find(',', at) + 1 - at);
  const std::string message =
      message_of([&] { passive_network_model_from_json(parse_json(text, "old.json")); });
  CHECK(message.find("of an earlier Dashpot") != std::string::npos);
  CHECK(message.find("identify it again") != std::string::npos);
}

TEST_CASE("beyond the drive of the data networks do not read it, and levers go on") {
  // The same network, read and blind: without the weights by which networks read the drive.
  PassiveNetwork reading = example_passive_network(8, 0.5);
  reading.lags = false;
  reading.drive_low = 0.5;
  reading.drive_fade = 0.25;
  PassiveNetwork blind = reading;
  const PassiveLayout at(blind.sizes);
  constexpr std::size_t kDrive = 2;  // of v, x, q
  for (std::size_t k = at.weights + kDrive; k < at.gates; k += blind.sizes.inputs())
    blind.numbers[k] = 0;
  for (std::size_t k = at.viscous_weights + kDrive; k < at.viscous; k += blind.sizes.seen() + 1)
    blind.numbers[k] = 0;

  const auto force = [](const PassiveNetwork& network, double drive) {
    DamperInput from{0, 0, drive}, to{0.001, 0.1, drive};
    std::vector<double> state(network.size());
    network.rest(from, state);
    network.advance(from, to, 0.02, state);
    return network.force(to, state);
  };
  for (const double drive : {0.6, 1.9, 0.4, 2.1})
    CHECK(std::abs(force(reading, drive) - force(blind, drive)) > 1e-3);
  for (const double drive : {0.25, 0.0, 2.25, 4.0})
    CHECK_CLOSE(force(reading, drive), force(blind, drive), 1e-12, 0);
  CHECK(force(reading, 4) != force(reading, 2.25));

  // Without a fade they read the end of the data's drive there.
  reading.drive_fade = 0;
  CHECK(std::abs(force(reading, 0) - force(blind, 0)) > 1e-3);
}

TEST_CASE("the force does not depend on how a motion is sampled") {
  const PassiveNetwork network = example_passive_network(4, 0.3);
  const auto forces = [&](double step) {
    const auto motion = [](double time) {
      return DamperInput{0.01 * std::sin(20 * time), 0.2 * std::cos(20 * time),
                         1 + 0.5 * std::sin(3 * time)};
    };
    std::vector<double> state(network.size()), found;
    network.rest(motion(0), state);
    const int every = static_cast<int>(std::lround(0.004 / step));
    for (int k = 0; k < 250 * every; ++k) {
      network.advance(motion(k * step), motion((k + 1) * step), step, state);
      if (k % every == every - 1) found.push_back(network.force(motion((k + 1) * step), state));
    }
    return found;
  };

  // Of the force's power, at most 0.1 % between 4, 1 and 0.25 ms.
  const std::vector<double> coarse = forces(0.004), middle = forces(0.001), fine = forces(0.00025);
  double power = 0, coarse_error = 0, middle_error = 0;
  for (std::size_t k = 0; k < fine.size(); ++k) {
    power += fine[k] * fine[k];
    coarse_error += (coarse[k] - fine[k]) * (coarse[k] - fine[k]);
    middle_error += (middle[k] - fine[k]) * (middle[k] - fine[k]);
  }
  CHECK(coarse_error < 1e-3 * power);
  CHECK(middle_error < 1e-3 * power);
}

TEST_CASE("what the motion puts in is stored or drained, and nothing that drains gives back") {
  for (const std::uint64_t seed : {1, 4, 9}) {
    const PassiveNetworkModel model(
        "passive_network",
        {example_passive_network(seed, 0.5), example_passive_network(seed + 20, 0.5)}, 50);
    std::vector<double> time;
    std::vector<DamperInput> inputs;
    for (int k = 0; k <= 20000; ++k) {
      const double t = k * 2e-5;
      time.push_back(t);
      inputs.push_back({0.01 * std::sin(30 * t), 0.3 * std::cos(30 * t), 1 + std::sin(7 * t)});
    }
    const EnergyBalance energy = energy_balance(model, time, inputs);
    REQUIRE(energy.work.size() == time.size());
    CAPTURE(seed);

    const double scale = *std::ranges::max_element(energy.work);
    double worst = 0;
    for (std::size_t k = 0; k < time.size(); ++k)
      worst = std::max(worst, std::abs(energy.work[k] - energy.stored[k] - energy.creep[k] -
                                       energy.friction[k] - energy.viscous[k] - energy.inertia[k]));
    CHECK(worst < 2e-3 * scale);
    for (const auto* drained : {&energy.creep, &energy.friction, &energy.viscous, &energy.inertia})
      CHECK(std::ranges::is_sorted(*drained));
  }
  CHECK(
      energy_balance(PassiveNetworkModel("p", {example_passive_network(1)}), {}, {}).work.empty());
}
