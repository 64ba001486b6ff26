#include "dashpot/damper/kinds/state_space/train_state_space.h"

#include "damper/nets/free_run_record_example.h"
#include "state_space_example.h"
#include "support.h"

using namespace dashpot;

namespace {

std::vector<FreeRunRecord> measured(std::size_t samples) {
  return measured(StateSpaceModel("truth", {example_state_space(3)}), samples, 10);
}

/// Other rates and weights than the truth's, no feedback yet.
StateSpaceNetwork start_cell() {
  StateSpaceNetwork model = example_state_space(9);
  model.cell.path_rates = {20, 150};
  model.cell.initialise(3, 9);
  model.network.initialise(2, 9);
  return model;
}

void check_cell_gradient(const StateSpaceTrainOptions& options, double tolerance = 1e-6) {
  const std::vector<FreeRunRecord> records = measured(90);
  const StateSpaceNetwork model = example_state_space(4);
  const std::size_t count = state_space_cost(model, all_of(records), options).gradient.size();
  std::vector<double> at = model.cell.parameters();
  Random random(2);  // weights of the encoder, which the model has not
  while (at.size() < count - model.network.parameter_count()) at.push_back(0.2 * random.normal());
  at.insert(at.end(), model.network.neurons.begin(), model.network.neurons.end());
  at.insert(at.end(), model.network.gates.begin(), model.network.gates.end());
  REQUIRE(at.size() == count);
  const FreeRunCost cost = state_space_cost(model, all_of(records), options, at);
  for (std::size_t k = 0; k < count; ++k) {
    const auto moved = [&](double by) {
      std::vector<double> x = at;
      x[k] += by;
      return state_space_cost(model, all_of(records), options, x).cost;
    };
    CAPTURE(k);
    CHECK_CLOSE(2 * cost.gradient[k], (moved(1e-5) - moved(-1e-5)) / 2e-5, tolerance, 1e-7);
  }
}

}  // namespace

TEST_CASE("the gradient is that of the cost over whole records, rest included") {
  check_cell_gradient({.weight_decay = 0.01, .rate_decay = 0.02, .offset_decay = 0.3, .stride = 2});
}

TEST_CASE("the gradient is that of the cost over windows, encoder included") {
  check_cell_gradient(
      {.weight_decay = 0.01, .rate_decay = 0.02, .offset_decay = 0.3, .window = 30});
}

TEST_CASE("the gradient is that of the cost with the penalty of energy that is fed in") {
  std::vector<ProbeSine> sines;  // every 67th of a verdict's, quick and slow, small and beyond
  const auto all = probe_sines({-0.02, 0.02, -0.3, 0.3, 0.2, 1.8}, false, true);
  for (std::size_t k = 0; k < all.size(); k += 67) sines.push_back(all[k]);
  const ActivityPenalty penalty(sines, 0.5);
  const std::vector<FreeRunRecord> records = measured(90);
  CHECK(state_space_cost(example_state_space(4), all_of(records), {.penalty = &penalty}).cost >
        1.1 * state_space_cost(example_state_space(4), all_of(records), {}).cost);
  check_cell_gradient({.weight_decay = 0.01, .penalty = &penalty}, 1e-4);  // shares have kinks
}

TEST_CASE("windows, then whole records: a state space predicts motions it has not seen") {
  const std::vector<FreeRunRecord> records = measured(400);
  const std::vector<const FreeRunRecord*> seen{&records[0], &records[2]};
  const auto trained = [&] {
    StateSpaceNetwork model = start_cell();
    train(model, seen, {.max_iterations = 15, .weight_decay = 1e-6, .window = 50});
    const FreeRunTrainReport report =
        train(model, seen, {.max_iterations = 40, .weight_decay = 1e-7});
    CHECK(report.iterations > 0);
    return model;
  };
  const StateSpaceNetwork found = trained(), again = trained();
  CHECK(found.cell.parameters() == again.cell.parameters());
  CHECK(found.network.gates == again.network.gates);
  StateSpaceNetwork none = start_cell();
  none.network.gates.assign(none.network.gates.size(), 0.0);
  const auto left = [&](const StateSpaceNetwork& model) {
    return squares_left(model, records[1], true);
  };
  CHECK(std::sqrt(left(found) / left(none)) < 0.2);  // it has seen two motions of 1.6 s
  CHECK(found.cell.velocity_high < 2);               // 0.35 m/s by its scale: held to what was seen
}

TEST_CASE("records too short for a window serve whole") {
  const std::vector<FreeRunRecord> records = measured(15);
  StateSpaceNetwork model = start_cell();
  CHECK(train(model, all_of(records), {.max_iterations = 2, .window = 400}).rmse > 0);
  std::vector<FreeRunRecord> tiny = measured(12);
  for (FreeRunRecord& record : tiny) record.first = 0;
  const std::vector<FreeRunRecord> one(tiny.begin(), tiny.begin() + 1);
  CHECK(std::isfinite(state_space_cost(model, all_of(one), {.window = 400}).cost));
}
