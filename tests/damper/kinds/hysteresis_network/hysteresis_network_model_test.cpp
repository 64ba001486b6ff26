#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"

#include <algorithm>

#include "damper/kinds/hysteresis_network/hysteresis_network_example.h"
#include "sanitized.h"
#include "support.h"

using namespace dashpot;

namespace {

HysteresisNetworkModel example() {
  return HysteresisNetworkModel(
      "hysteresis_network", {example_hysteresis_network(1), example_hysteresis_network(2)}, 4.5);
}

double bound_of(const GatedNetwork& network, double fastest) {
  // Standardised motions: the velocity within the fastest, v - y held within 3, Dahl states and
  // neurons within 1; |u| <= 1.
  double sum = 0;
  for (std::size_t term = 0; term < network.term_count(); ++term) {
    const double most = term == 1 ? fastest / network.signals[0].scale : term == 4 ? 3 : 1;
    for (std::size_t k = 0; k < network.gate_count(); ++k)
      sum += std::abs(network.gates[term * network.gate_count() + k]) * most;
  }
  return network.output_scale * sum;
}

}  // namespace

TEST_CASE("the force is the members' mean and the offset") {
  const HysteresisNetworkModel both = example();
  const HysteresisNetworkModel first("a", {example_hysteresis_network(1)}),
      second("b", {example_hysteresis_network(2)});
  const std::vector<double> state{0.1, -0.3, 0.02, 0.5, 0.6, 0.7, -0.05, 1.2};
  const DamperInput input{9, 0.1, 1};
  const std::span<const double> all(state);
  CHECK_CLOSE(both.force(input, state),
              (first.force(input, all.first(4)) + second.force(input, all.last(4))) / 2 + 4.5,
              1e-14, 0);
  CHECK(both.is_ensemble());
  CHECK_CLOSE(both.spread(input, state),
              std::abs(first.force(input, all.first(4)) - second.force(input, all.last(4))) /
                  std::sqrt(2.0),
              1e-12, 0);
  CHECK(first.spread(input, all.first(4)) == 0);
  CHECK(both.state_size() == 8);
  CHECK(both.parameter_count() == 2 * (4 + 3 * 6 + 8 * 3));
  CHECK_FALSE(both.needs_displacement());
}

TEST_CASE("random steps of any size stay within the bound that the weights give") {
  const HysteresisNetwork member = example_hysteresis_network();
  const HysteresisNetworkModel model("test", {member});
  std::vector<double> state(model.state_size());
  Random random(11);
  const auto any = [&](double least, double most) {
    return (random.uniform() < 0.5 ? -1 : 1) * std::pow(10, random.uniform(least, most));
  };
  const double fastest = 1e60, bound = bound_of(member.network, fastest);
  DamperInput from;
  model.rest(from, state);
  std::size_t outside = 0;
  for (int k = 0; k < (kSanitized ? 50'000 : 1'000'000); ++k) {
    const DamperInput to{0, any(-60, 60), any(-60, 60)};
    model.advance(from, to, std::abs(any(-9, 6)), state);
    outside += !(std::abs(model.force(to, state)) <= bound && std::abs(state[0]) <= 1 + 1e-15);
    from = to;
  }
  CHECK(outside == 0);
}

TEST_CASE("offsets add up and JSON keeps every bit") {
  const auto moved = example().with_offset(3);
  const auto back =
      hysteresis_network_model_from_json(parse_json(format_json(moved->to_json()), "m.json"));
  CHECK(format_json(back->to_json()) == format_json(moved->to_json()));
  const std::vector<double> state(8, 0.1);
  CHECK(back->force({0, 0.4, 1}, state) == moved->force({0, 0.4, 1}, state));
  CHECK_CLOSE(moved->force({0, 0.4, 1}, state), example().force({0, 0.4, 1}, state) + 3, 1e-14, 0);
}

TEST_CASE("a hysteresis network that does not fit together is refused") {
  const auto message = [](const std::string& from, const std::string& to) {
    std::string text =
        format_json(HysteresisNetworkModel("x", {example_hysteresis_network()}).to_json(), false);
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    return message_of([&] { hysteresis_network_model_from_json(parse_json(text, "m.json")); });
  };
  const auto mentions = [](const std::string& text, const char* part) {
    CAPTURE(text);
    return text.find(part) != std::string::npos;
  };
  CHECK(message("path", "path") == "");
  CHECK(mentions(message("[60,500]", "[60,-500]"), "a rate is not a positive number"));
  CHECK(mentions(message("[60,500]", "[60]"), "has 5 signals; its states need 4"));
  CHECK(mentions(message("\"current_rates\":[50]", "\"current_rates\":[]"),
                 "has 0 current rates; 1 to 4"));
  CHECK(mentions(message("\"scale\":0.2", "\"scale\":0"),
                 "the scale of a signal is not a positive number"));
  CHECK(mentions(message("\"low\":-3", "\"low\":4"), "the range of a signal does not go upwards"));
  CHECK(mentions(message("\"neurons\":[", "\"neurons\":[0,"), "each neuron needs 6"));
  CHECK(mentions(message("\"gates\":[", "\"gates\":[0,"),
                 "has 25 weights of gates; its states need 24"));
  CHECK(mentions(message("1000", "-1"), "the output scale is not a positive number"));
  CHECK(mentions(message("\"neurons\"", "\"neuron\""), "needs 'neurons'"));
  CHECK(mentions(message("\"offset\"", "\"off\""), "needs 'offset'"));
  CHECK(message_of([] { HysteresisNetworkModel("x", {}); }).find("has no members") !=
        std::string::npos);
}
