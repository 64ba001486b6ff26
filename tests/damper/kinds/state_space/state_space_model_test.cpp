#include "dashpot/damper/kinds/state_space/state_space_model.h"

#include "state_space_example.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("the force of a state space is the members' mean and the offset") {
  const StateSpaceModel both("neural_state_space", {example_state_space(1), example_state_space(2)},
                             4.5);
  const StateSpaceModel first("a", {example_state_space(1)}), second("b", {example_state_space(2)});
  const std::vector<double> state{0.1, -0.3, 0.4, 0.5, 0.6, 0.7, -0.5, 0.2};
  const std::span<const double> all(state);
  const DamperInput input{9, 0.1, 1};
  CHECK_CLOSE(both.force(input, state),
              (first.force(input, all.first(4)) + second.force(input, all.last(4))) / 2 + 4.5,
              1e-14, 0);
  CHECK_CLOSE(both.spread(input, state),
              std::abs(first.force(input, all.first(4)) - second.force(input, all.last(4))) /
                  std::sqrt(2.0),
              1e-12, 0);
  CHECK(first.spread(input, all.first(4)) == 0);
  CHECK(both.state_size() == 8);
  CHECK(both.kind() == ModelKind::StateSpace);
  // 4 rates, 3 neurons of 6, 2 x 3 rows over 1 + 2 + 1 + 3; 2 neurons of 6, 7 terms of 3 gates
  CHECK(both.parameter_count() == 2 * (4 + 18 + 42 + 12 + 21));
  CHECK_FALSE(both.needs_displacement());
}

TEST_CASE("JSON of a state space keeps every bit") {
  const auto moved = StateSpaceModel("x", {example_state_space()}, 1).with_offset(3);
  const auto back =
      state_space_model_from_json(parse_json(format_json(moved->to_json()), "m.json"));
  CHECK(format_json(back->to_json()) == format_json(moved->to_json()));
  std::vector<double> one(4), two(4);
  moved->rest({0, 0, 1}, one);
  back->rest({0, 0, 1}, two);
  moved->advance({0, 0, 1}, {0, 0.3, 1.2}, 0.01, one);
  back->advance({0, 0, 1}, {0, 0.3, 1.2}, 0.01, two);
  CHECK(one == two);
  CHECK(moved->force({0, 0.3, 1.2}, one) == back->force({0, 0.3, 1.2}, two));
}

TEST_CASE("a state space that does not fit together is refused") {
  const auto message = [](const std::string& from, const std::string& to) {
    std::string text = format_json(StateSpaceModel("x", {example_state_space()}).to_json(), false);
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    return message_of([&] { state_space_model_from_json(parse_json(text, "m.json")); });
  };
  const auto mentions = [](const std::string& text, const char* part) {
    CAPTURE(text);
    return text.find(part) != std::string::npos;
  };
  CHECK(message("path", "path") == "");
  CHECK(mentions(message("[12,100]", "[12,-100]"), "a rate is not a positive number"));
  CHECK(mentions(message("[12,100]", "[]"),
                 "the cell has 18 weights of neurons; each neuron needs 4"));
  CHECK(mentions(message("\"current_rates\":[50]", "\"current_rates\":[]"),
                 "has 0 current rates; 1 to 4"));
  CHECK(mentions(message("\"velocity_range\":[-3,3]", "\"velocity_range\":[3,-3]"),
                 "does not go upwards"));
  CHECK(mentions(message("\"velocity_range\":[-3,3]", "\"velocity_range\":[3]"), "is not a range"));
  CHECK(mentions(message("\"model_step\":0.002", "\"model_step\":0"),
                 "the model step is not a positive"));
  CHECK(
      mentions(message("\"neurons\":[", "\"neurons\":[0,"), "the cell has 19 weights of neurons"));
  CHECK(mentions(message("\"feedback\":[", "\"feedback\":[0,"), "has 43 weights of feedback"));
  CHECK(mentions(message("\"gates\":[", "\"gates\":[0,"),
                 "has 22 weights of gates; its states need 21"));
  CHECK(mentions(message("\"cell\"", "\"cel\""), "needs 'cell'"));
  CHECK(message_of([] { StateSpaceModel("x", {}); }).find("has no members") != std::string::npos);
}
