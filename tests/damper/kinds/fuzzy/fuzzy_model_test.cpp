#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"

#include "support.h"

using namespace dashpot;

namespace {

using Shape = Membership::Shape;

/// One rule of 1 N per unit of each input, split in two that say the same.
FuzzyModel model(const std::vector<std::string>& inputs, FuzzyInputs::Lags lags = {}) {
  Sugeno sugeno;
  sugeno.inputs.assign(inputs.size(), {0, 1, -1, 1});
  sugeno.memberships = {
      {Shape::Bell, 0, -1, 1, 2}, {Shape::Sigmoid, 0, 1, 1, -5}, {Shape::Gaussian, 0, 0, 2, 1}};
  sugeno.rules = {{0}, {1, 2}};
  for (int rule = 0; rule < 2; ++rule) {
    sugeno.consequents.insert(sugeno.consequents.end(), inputs.size(), 1.0);
    sugeno.consequents.push_back(0);
  }
  return FuzzyModel("test", FuzzyInputs(inputs, lags, "test"), sugeno);
}

}  // namespace

TEST_CASE("the named inputs reach the rules") {
  CHECK_CLOSE(model({"velocity", "current"}).force({99, 0.3, -0.5}, {}), -0.2, 1e-12, 0);
  CHECK_CLOSE(model({"displacement"}).force({7, 0.3, -0.5}, {}), 7, 1e-12, 0);
  CHECK(model({"displacement"}).needs_displacement());
  CHECK_FALSE(model({"velocity", "current"}).needs_displacement());
  CHECK(model({"velocity", "current"}).state_size() == 0);
}

TEST_CASE("past velocity and coil follow their lags, whatever the step") {
  // A first-order lag T behind a ramp s t from 0: s (t - T (1 - e^(-t / T))).
  const FuzzyModel both = model({"velocity_change", "current"}, {.velocity = 0.02, .coil = 0.05});
  REQUIRE(both.state_size() == 2);
  const double end = 0.1;
  const double change = 3 * (0.02 * (1 - std::exp(-end / 0.02)));
  const double coil = 1 + 5 * (end - 0.05 * (1 - std::exp(-end / 0.05)));
  for (const int steps : {1, 7}) {
    const auto input = [&](int k) {
      const double t = end * k / steps;
      return DamperInput{0, 3 * t, 1 + 5 * t};
    };
    std::vector<double> state(2, NAN);
    both.rest(input(0), state);
    CHECK_CLOSE(both.force(input(0), state), 1, 1e-12,
                0);  // at rest the coil has what it was given
    for (int k = 0; k < steps; ++k) both.advance(input(k), input(k + 1), end / steps, state);
    CHECK_CLOSE(both.force(input(steps), state), change + coil, 1e-12, 0);
  }
}

TEST_CASE("an offset adds up and survives JSON, as do the lags") {
  const auto moved =
      model({"velocity_change", "current"}, {0.02, 0.05}).with_offset(3)->with_offset(0.5);
  const auto back = fuzzy_model_from_json(parse_json(format_json(moved->to_json()), "m.json"));
  CHECK(format_json(back->to_json()) == format_json(moved->to_json()));
  const std::vector<double> state{0.1, 0.7};
  CHECK_CLOSE(moved->force({0, 0.4, 1}, state), 0.3 + 0.7 + 3.5, 1e-12, 0);
  CHECK(back->force({0, 0.4, 1}, state) == moved->force({0, 0.4, 1}, state));
  CHECK(back->parameter_count() == 3 + 2 + 2 + 2 * 3 + 2);
}

TEST_CASE("a fuzzy model that does not fit together is refused") {
  const auto message = [](const std::string& from, const std::string& to) {
    std::string text = format_json(model({"velocity", "current"}).to_json(), false);
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    return message_of([&] { fuzzy_model_from_json(parse_json(text, "m.json")); });
  };
  const auto mentions = [](const std::string& text, const char* part) {
    CAPTURE(text);
    return text.find(part) != std::string::npos;
  };
  CHECK(message("velocity", "velocity") == "");
  CHECK(mentions(message("\"velocity\"", "\"speed\""), "unknown fuzzy input 'speed'"));
  CHECK(mentions(message("\"bell\"", "\"ball\""), "unknown shape 'ball'; did you mean 'bell'?"));
  CHECK(mentions(message("\"scale\":1", "\"scale\":0"),
                 "the scale of an input is not a positive number"));
  CHECK(mentions(message("\"low\":-1", "\"low\":2"), "does not go upwards"));
  CHECK(mentions(message("\"width\":1", "\"width\":-1"), "width is not a positive number"));
  CHECK(mentions(message("\"slope\":2", "\"slope\":0"), "bell's slope is not a positive number"));
  CHECK(mentions(message("\"input\":0", "\"input\":2"), "counted from 0 to 1"));
  CHECK(mentions(message("\"input\":0", "\"input\":0.5"), "write a whole number"));
  CHECK(mentions(message("\"rules\":[[0]", "\"rules\":[[3]"), "counted from 0 to 2"));
  CHECK(mentions(message("\"rules\":[[0]", "\"rules\":[[]"), "has 0 memberships in a rule"));
  CHECK(mentions(message("\"rules\":[[0],", "\"rules\":["), "these rules need 3"));
  CHECK(mentions(message("\"coil_lag\":0", "\"coil_lag\":-1"), "seconds, 0 for none"));
  CHECK(mentions(message("\"velocity_lag\":0.01", "\"velocity_lag\":0"), "seconds above 0"));
  CHECK(mentions(message("\"offset\"", "\"off\""), "needs 'offset'"));
}
