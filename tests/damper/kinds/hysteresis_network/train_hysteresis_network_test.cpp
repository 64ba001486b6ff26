#include "dashpot/damper/kinds/hysteresis_network/train_hysteresis_network.h"

#include "damper/nets/free_run_record_example.h"
#include "hysteresis_network_example.h"
#include "support.h"

using namespace dashpot;

namespace {

std::vector<FreeRunRecord> measured(const HysteresisNetwork& truth, std::size_t samples) {
  return measured(HysteresisNetworkModel("truth", {truth}), samples, 20);
}

/// Other weights and rates than the truth's.
HysteresisNetwork start_bank() {
  HysteresisNetwork model = example_hysteresis_network(9);
  model.bank.set_rates(std::vector<double>{90, 700, 80, 30});
  return model;
}

void check_bank_gradient(const HysteresisNetworkTrainOptions& options, double tolerance = 1e-6) {
  const std::vector<FreeRunRecord> records = measured(example_hysteresis_network(), 150);
  const HysteresisNetwork model = start_bank();
  const FreeRunCost at = hysteresis_network_cost(model, all_of(records), options);
  // Moves of rates are measured from the model that a training starts from, so their penalty has no
  // slope here.
  const auto slope = [&](auto move) {
    HysteresisNetwork above = model, below = model;
    move(above, 1e-5);
    move(below, -1e-5);
    return (hysteresis_network_cost(above, all_of(records), options).cost -
            hysteresis_network_cost(below, all_of(records), options).cost) /
           2e-5;
  };
  std::size_t k = 0;
  for (; k < model.bank.size(); ++k)
    CHECK_CLOSE(2 * at.gradient[k], slope([&](HysteresisNetwork& m, double by) {
                  std::vector<double> rates = m.bank.rates();
                  rates[k] *= std::exp(by);
                  m.bank.set_rates(rates);
                }),
                tolerance, 1e-8);
  for (std::size_t i = 0; i < model.network.neurons.size(); ++i)
    CHECK_CLOSE(2 * at.gradient[k++],
                slope([&](HysteresisNetwork& m, double by) { m.network.neurons[i] += by; }),
                tolerance, 1e-8);
  for (std::size_t i = 0; i < model.network.gates.size(); ++i)
    CHECK_CLOSE(2 * at.gradient[k++],
                slope([&](HysteresisNetwork& m, double by) { m.network.gates[i] += by; }),
                tolerance, 1e-8);
}

}  // namespace

TEST_CASE("the gradient is that of the cost, rates, offsets and decays included") {
  check_bank_gradient({.weight_decay = 0.01, .rate_decay = 0.02, .offset_decay = 0.3, .stride = 2});
}

TEST_CASE("the gradient is that of the cost with the penalty of energy that is fed in") {
  std::vector<ProbeSine> sines;  // every 67th of a verdict's, quick and slow, small and beyond
  const auto all = probe_sines({-0.02, 0.02, -0.3, 0.3, 0.2, 1.8}, false, true);
  for (std::size_t k = 0; k < all.size(); k += 67) sines.push_back(all[k]);
  const ActivityPenalty penalty(sines, 0.5);
  const HysteresisNetworkTrainOptions free{.weight_decay = 0.01},
      paid{.weight_decay = 0.01, .penalty = &penalty};
  const std::vector<FreeRunRecord> records = measured(example_hysteresis_network(), 150);
  CHECK(hysteresis_network_cost(start_bank(), all_of(records), paid).cost >
        1.1 * hysteresis_network_cost(start_bank(), all_of(records), free).cost);
  check_bank_gradient(paid, 1e-4);  // shares have kinks
}

TEST_CASE(
    "training finds a network that predicts motions it has not seen, and the same one again") {
  const std::vector<FreeRunRecord> records = measured(example_hysteresis_network(), 400);
  const HysteresisNetworkTrainOptions options{.max_iterations = 80, .weight_decay = 1e-7};
  const std::vector<const FreeRunRecord*> seen{&records[0], &records[2]};
  HysteresisNetwork found = start_bank(), again = start_bank();
  const FreeRunTrainReport report = train(found, seen, options);
  train(again, seen, options);
  CHECK(found.network.neurons == again.network.neurons);
  CHECK(found.network.gates == again.network.gates);
  CHECK(found.bank.rates() == again.bank.rates());
  const auto left = [&](const HysteresisNetwork& model) {
    return squares_left(model, records[1], true);
  };
  HysteresisNetwork none = start_bank();
  none.network.gates.assign(none.network.gates.size(), 0.0);
  CHECK(std::sqrt(left(found) / left(none)) < 0.02);
  CHECK(report.rmse < 15);  // N, of some 1000
  CHECK(report.iterations > 0);
}

TEST_CASE("offsets of records stay out of the model, their mean goes in") {
  const std::vector<FreeRunRecord> records = measured(example_hysteresis_network(), 200);
  HysteresisNetwork found = start_bank();
  const FreeRunTrainReport free =
      train(found, all_of(records), {.max_iterations = 60, .weight_decay = 1e-7});
  HysteresisNetwork held = start_bank();
  const FreeRunTrainReport bound =
      train(held, all_of(records), {.max_iterations = 60, .weight_decay = 1e-7, .offsets = false});
  CHECK(free.rmse < bound.rmse / 2);
}

TEST_CASE("signals are held within those of the records") {
  const std::vector<FreeRunRecord> records = measured(example_hysteresis_network(), 200);
  HysteresisNetwork found = start_bank();
  train(found, all_of(records), {.max_iterations = 3});
  const GatedNetwork::Signal &velocity = found.network.signals.front(),
                             &current = found.network.signals.back();
  double top = 0;
  for (const FreeRunRecord& record : records)
    for (const DamperInput& input : record.inputs) top = std::max(top, input.velocity);
  CHECK_CLOSE(velocity.high * velocity.scale, top, 1e-12, 0);
  CHECK(current.high <= 0.8);  // (1.8 - 1) / 1
  CHECK(current.low >= -0.8);
}
