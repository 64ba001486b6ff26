#include "dashpot/damper/kinds/network/network_model.h"

#include <array>

#include "support.h"

using namespace dashpot;

namespace {

/// The (2,10,1) network of TC-12; its two inputs come from the named channels.
NetworkModel network(const std::vector<std::string>& inputs) {
  Mlp mlp;
  mlp.layers = {2, 10, 1};
  mlp.parameters.resize(41);
  for (int i = 0; i < 10; ++i) {
    mlp.parameters[2 * i] = std::sin(i + 1.0);
    mlp.parameters[2 * i + 1] = std::cos(i + 1.0);
    mlp.parameters[20 + i] = 0.1 * (i - 4.5);
    mlp.parameters[30 + i] = (i % 2 ? -1.0 : 1.0) / (i + 1);
  }
  mlp.parameters[40] = 0.05;
  mlp.input_mean = {0, 0};
  mlp.input_scale = {1, 1};
  return NetworkModel("test", inputs, {mlp});
}

}  // namespace

TEST_CASE("the named inputs reach the network in their order (TC-12)") {
  const NetworkModel one = network({"velocity", "current"});
  CHECK_CLOSE(one.force({99, 0.3, -0.5}, {}), -0.40879391, 0, 5e-9);
  CHECK_CLOSE(one.force({99, 1, 1}, {}), 0.53232924, 0, 5e-9);
  CHECK_FALSE(one.needs_displacement());
  const NetworkModel other = network({"current", "displacement"});
  CHECK_CLOSE(other.force({-0.5, 99, 0.3}, {}), -0.40879391, 0, 5e-9);
  CHECK(other.needs_displacement());
}

TEST_CASE("an offset adds up and survives JSON") {
  const auto moved = network({"velocity", "current"}).with_offset(3)->with_offset(0.5);
  CHECK_CLOSE(moved->force({0, 1, 1}, {}), 0.53232924 + 3.5, 0, 5e-9);
  const auto back = network_model_from_json(parse_json(format_json(moved->to_json()), "m.json"));
  CHECK(back->force({0, 1, 1}, {}) == moved->force({0, 1, 1}, {}));
}

TEST_CASE("activations survive JSON; a file without them means tanh and a linear output") {
  Mlp mlp = network({"velocity", "current"}).members().front();
  CHECK(format_json(NetworkModel("m", {"velocity", "current"}, {mlp}).to_json())
            .find("activations") == std::string::npos);
  mlp.activations = {Activation::Relu, Activation::Sigmoid};
  const NetworkModel model("m", {"velocity", "current"}, {mlp});
  const std::string text = format_json(model.to_json(), false);
  CHECK(text.find(R"("activations":["relu","sigmoid"])") != std::string::npos);
  const auto back = network_model_from_json(parse_json(text, "m.json"));
  CHECK(back->force({0, 0.3, -0.5}, {}) == model.force({0, 0.3, -0.5}, {}));
  CHECK_CLOSE(back->force({0, 0.3, -0.5}, {}), mlp.evaluate(std::array{0.3, -0.5}.data()), 1e-12,
              0);
  const auto refused = [&](const std::string& activations) {
    std::string other = text;
    other.replace(other.find(R"(["relu","sigmoid"])"), 18, activations);
    return message_of([&] { network_model_from_json(parse_json(other, "m.json")); });
  };
  CHECK(refused(R"(["relu"])").find("one for each layer behind the inputs") != std::string::npos);
  CHECK(refused(R"(["relu","sigmoit"])").find("did you mean 'sigmoid'") != std::string::npos);
}

TEST_CASE("several networks answer with their mean, and survive JSON to the last bit") {
  const Mlp one = network({"velocity", "current"}).members().front();
  Mlp other = one;
  for (double& weight : other.parameters) weight *= 0.7;
  other.output_mean = 2;
  const NetworkModel model("m", {"velocity", "current"}, {one, other}, 0.25);
  CHECK(model.parameter_count() == 82);
  const double x[] = {0.3, -0.5};
  CHECK_CLOSE(model.force({0, x[0], x[1]}, {}), (one.evaluate(x) + other.evaluate(x)) / 2 + 0.25,
              1e-12, 0);
  CHECK(model.is_ensemble());
  CHECK_CLOSE(model.spread({0, x[0], x[1]}, {}),
              std::abs(one.evaluate(x) - other.evaluate(x)) / std::sqrt(2.0), 1e-9, 0);
  CHECK(!NetworkModel("m", {"velocity", "current"}, {one}).is_ensemble());
  const std::string text = format_json(model.to_json());
  const auto back = network_model_from_json(parse_json(text, "m.json"));
  CHECK(format_json(back->to_json()) == text);
  CHECK(back->force({0, 0.3, -0.5}, {}) == model.force({0, 0.3, -0.5}, {}));
  CHECK(message_of([] {
          NetworkModel("m", {"velocity"}, std::vector<Mlp>{});
        }).find("has no members") != std::string::npos);
  std::string broken = text;
  broken.replace(broken.rfind("\"output_scale\": 1"), 17, "\"output_scale\": 0");
  CHECK(message_of([&] {
          network_model_from_json(parse_json(broken, "m.json"));
        }).find("members") != std::string::npos);
}

TEST_CASE("a network that does not fit together is refused") {
  const auto message = [](const std::string& from, const std::string& to) {
    std::string text = format_json(network({"velocity", "current"}).to_json(), false);
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    return message_of([&] { network_model_from_json(parse_json(text, "m.json")); });
  };
  const auto mentions = [](const std::string& text, const char* part) {
    CAPTURE(text);
    return text.find(part) != std::string::npos;
  };
  CHECK(message("velocity", "velocity") == "");
  CHECK(mentions(message("velocity", "speed"), "unknown network input 'speed'"));
  CHECK(mentions(message("\"velocity\",", ""), "do not go from 1 inputs to one force"));
  CHECK(mentions(message("[2,10,1]", "[2,11,1]"), "these layers need 45"));
  CHECK(mentions(message("[2,10,1]", "[2,1e9,1]"), "write a whole number"));
  CHECK(mentions(message("[2,10,1]", "[2,-1,1]"), "write a whole number"));
  CHECK(mentions(message("\"input_scale\":[1", "\"input_scale\":[0"),
                 "a scale is not a positive number"));
  CHECK(mentions(message("\"offset\"", "\"off\""), "needs 'offset'"));
}
