#include <cmath>

#include "damper/kinds/passive_network/passive_network_example.h"
#include "support.h"

using namespace dashpot;

namespace {

std::vector<FreeRunRecord> noisy_records() {
  Random random(3);
  std::vector<FreeRunRecord> records(3);
  for (std::size_t r = 0; r < records.size(); ++r)
    for (int k = 0; k < 300; ++k) {
      const double time = k * 0.002, phase = 9 * time + static_cast<double>(r);
      records[r].inputs.push_back(
          {0.01 * std::sin(phase), 0.09 * std::cos(phase), 0.5 + 0.4 * std::sin(5 * time)});
      records[r].time.push_back(time);
      records[r].force.push_back(500 * std::cos(phase) + 50 * random.normal());
    }
  return records;
}

std::vector<const FreeRunRecord*> pointers_to(const std::vector<FreeRunRecord>& records) {
  std::vector<const FreeRunRecord*> pointers;
  for (const FreeRunRecord& record : records) pointers.push_back(&record);
  return pointers;
}

}  // namespace

TEST_CASE("gradients through time are those of differences, for every number") {
  PassiveNetwork network = example_passive_network(2, 0.3);
  const std::vector<FreeRunRecord> made = noisy_records();
  const std::vector<const FreeRunRecord*> records = pointers_to(made);
  // In some of the windows networks do not read the drive.
  const PassiveTrainOptions options{.window = 100, .run_in = 20, .blind_share = 0.5};
  const FreeRunCost at = passive_cost(network, records, options);

  // The kernel counts in single precision, so a difference needs a wide step.
  double largest = 0;
  for (const double slope : at.gradient) largest = std::max(largest, std::abs(slope));
  for (std::size_t k = 0; k < network.numbers.size(); ++k) {
    const double number = network.numbers[k], step = 3e-3 * std::max(std::abs(number), 0.1);
    network.numbers[k] = number + step;
    const double above = passive_cost(network, records, options).cost;
    network.numbers[k] = number - step;
    const double below = passive_cost(network, records, options).cost;
    network.numbers[k] = number;
    CAPTURE(k);
    CHECK_CLOSE(at.gradient[k], (above - below) / (2 * step), 0.02, 1e-3 * largest);
  }
}

TEST_CASE("the windows' kernel has the force of the model") {
  const PassiveNetwork network = example_passive_network(5, 0.3);
  const std::vector<FreeRunRecord> made = noisy_records();
  const std::vector<const FreeRunRecord*> records = pointers_to(made);

  // A record's cost by the kernel is that of the model's own free run over the same window, but for
  // memories that settle longer before it there.
  PassiveTrainOptions options{.window = 364, .run_in = 64, .offsets = false};
  const double cost = passive_cost(network, records, options).cost;
  double expected = 0;
  Random random(options.seed);
  for (int window = 0; window < 32; ++window) {
    const FreeRunRecord& record = *records[random.index(records.size())];
    random.index(1);  // its only place
    expected += squares_left(network, record, false) / (network.force_scale * network.force_scale);
  }
  CHECK_CLOSE(cost, expected, 0.02, 0);
}

TEST_CASE("training lowers the error, and repeats to the bit") {
  const std::vector<FreeRunRecord> made = noisy_records();
  const std::vector<const FreeRunRecord*> records = pointers_to(made);
  const PassiveTrainOptions options{.updates = 60, .window = 128, .run_in = 32};
  PassiveNetwork network = example_passive_network(6, 0), again = network;
  const double before = passive_cost(network, records, options).cost;
  train(network, records, options);
  train(again, records, options);
  CHECK(passive_cost(network, records, options).cost < 0.5 * before);
  CHECK(network.numbers == again.numbers);
}

TEST_CASE("the follower of an inertia stays within what a step can tell") {
  // Quicker from the start, it is a difference of two samples.
  const std::vector<FreeRunRecord> made = noisy_records();
  PassiveNetwork network = example_passive_network(6, 0);
  double& rate = network.numbers[PassiveLayout(network.sizes).inertia_rate];
  rate = 40 / network.model_step;
  train(network, pointers_to(made), {.updates = 1, .window = 128, .run_in = 32});
  CHECK(rate <= 2.000001 / network.model_step);
}

TEST_CASE("a network that answers unlike the others to other speeds is a stray") {
  const std::vector<FreeRunRecord> made = noisy_records();
  const std::vector<const FreeRunRecord*> records = pointers_to(made);
  const PassiveNetwork base = example_passive_network(7, 0.2);
  const auto beside = [&](double departure, std::uint64_t seed) {
    PassiveNetwork network = base;
    Random random(seed);
    for (double& number : network.numbers) number *= std::exp(departure * random.normal());
    return network;
  };
  const PassiveNetwork a = beside(0.02, 1), b = beside(0.02, 2), c = beside(0.02, 3);
  const PassiveNetwork stray = beside(1, 4);

  CHECK(stray_members({a, b, c}, records).empty());
  CHECK(stray_members({a, stray, b}, records) == std::vector<std::size_t>{1});
  CHECK(stray_members({stray, a, b, c}, records) == std::vector<std::size_t>{0});
  // Of two, nobody can tell which one strays; nor of three that all differ.
  CHECK(stray_members({a, stray}, records).empty());
  CHECK(stray_members({beside(1, 5), beside(1, 6), beside(1, 7)}, records).empty());

  // One that differs where it was trained, too, but by little in newtons, stays.
  CHECK(stray_members({base, base, a}, records).empty());
}
