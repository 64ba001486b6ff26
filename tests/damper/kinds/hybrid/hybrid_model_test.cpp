#include "dashpot/damper/kinds/hybrid/hybrid_model.h"

#include "dashpot/damper/inverse/observer.h"
#include "dashpot/damper/registry.h"
#include "hybrid_model_example.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A viscous damper of 1000 N*s/m, and a network that adds 50 (1 + i) times the velocity in m/s,
/// mixed by 2.
HybridModel viscous(double low, double high) {
  GatedNetwork network;
  network.signals = {{0, 1, low, high}, {0, 1, -1e9, 1e9}, {0, 1, 0, 3}};
  network.currents = 1;
  network.gates = {0, 0, 0, 1, 1,
                   0, 0, 0, 0};  // of 1, the velocity and the law's force, each by 1, i, i^2
  network.output_scale = 25;
  return {
      {LawModel::constant(find_law("bingham"), {1000, 0, 0, 0}), {}}, {{0, 0}, {2, 0, 0}}, network};
}

}  // namespace

TEST_CASE("the network adds to the law's force and is held beyond the training records") {
  const HybridModel model = viscous(-1, 1);
  CHECK(model.name() == "bingham+network");
  CHECK(model.kind() == ModelKind::Hybrid);
  CHECK_FALSE(model.needs_displacement());
  CHECK_CLOSE(model.force({0, 0.2, 1}, {}), 1000 * 0.2 + 50 * 2 * 0.2, 1e-14, 0);
  // At 2 m/s the mixed signal would be 4; it stays at 1, and the law goes on. So does a current
  // above 3 A.
  CHECK_CLOSE(model.force({0, 2, 1}, {}), 1000 * 2 + 25 * 2, 1e-14, 0);
  CHECK_CLOSE(model.force({0, -2, 9}, {}), -1000 * 2 - 25 * 4, 1e-14, 0);
}

TEST_CASE("the states are the law's own: nothing feeds back") {
  const HybridModel model = example_hybrid();
  std::vector<double> state(model.state_size()), of_law(model.law().state_size());
  REQUIRE(state.size() == of_law.size() + 3);
  DamperInput from{0.01, 0, 0.5};
  model.rest(from, state);
  model.law().rest(from, of_law);
  for (int k = 0; k < 100; ++k) {
    const DamperInput to{0.01, 0.1 * std::sin(0.1 * k), 0.5 + 0.5 * std::cos(0.05 * k)};
    model.advance(from, to, 1e-3, state);
    model.law().advance(from, to, 1e-3, of_law);
    CHECK(std::equal(of_law.begin(), of_law.end(), state.begin()));
    from = to;
  }
}

TEST_CASE("offsets add up, do not disturb what the network reads, and JSON keeps every bit") {
  const auto moved = example_hybrid().with_offset(3);
  const auto back = hybrid_model_from_json(parse_json(format_json(moved->to_json()), "m.json"));
  CHECK(format_json(back->to_json()) == format_json(moved->to_json()));
  std::vector<double> state(moved->state_size());
  moved->rest({0.02, 0.1, 1}, state);
  CHECK(back->force({0.02, 0.1, 1}, state) == moved->force({0.02, 0.1, 1}, state));
  CHECK_CLOSE(moved->force({0.02, 0.1, 1}, state),
              example_hybrid().force({0.02, 0.1, 1}, state) + 3, 1e-13, 0);
}

TEST_CASE("without the coil's lag a hybrid reads the current that it is given") {
  const HybridModel model = example_hybrid();
  REQUIRE(model.law().lag_rate() > 0);
  const BareDamper bare = without_coil_lag(model);
  CHECK(bare.lag_rate == model.law().lag_rate());
  std::vector<double> lagging(model.state_size()), state(bare.model->state_size());
  const DamperInput input{0.02, 0.1, 1};  // at rest the coil has its command, lag or not
  model.rest(input, lagging);
  bare.model->rest(input, state);
  CHECK(bare.model->force(input, state) == model.force(input, lagging));
}

TEST_CASE("a hybrid that does not fit together is refused") {
  const auto message = [](const std::string& from, const std::string& to) {
    std::string text = format_json(viscous(-1, 1).to_json(), false);
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    return message_of([&] { hybrid_model_from_json(parse_json(text, "m.json")); });
  };
  const auto mentions = [](const std::string& text, const char* part) {
    CAPTURE(text);
    return text.find("m.json") == 0 && text.find(part) != std::string::npos;
  };
  CHECK(mentions(message("\"means\":[0,0]", "\"means\":[0]"),
                 "has 1 means of signals; its law and bank need 2"));
  CHECK(mentions(message("\"mixing\":[2", "\"mixing\":[2,1"),
                 "has 4 weights of signals; its law and bank need 3"));
  CHECK(mentions(message("{\"mean\":0,\"scale\":1,\"low\":0,\"high\":3}",
                         "{\"mean\":0,\"scale\":1,\"low\":4,\"high\":3}"),
                 "the range of a signal does not go upwards"));
  CHECK(mentions(message("\"gates\":[0", "\"gates\":[0,0"),
                 "has 10 weights of gates; its states need 9"));
  CHECK(mentions(message("\"law\":\"bingham\"", "\"law\":\"bingam\""), "did you mean 'bingham'"));
  CHECK(mentions(message("\"path_rates\":[]", "\"path_rates\":[0]"),
                 "a rate is not a positive number"));
  CHECK(mentions(message("\"current_rates\":[]", "\"current_rates\":[1,2,3,4]"),
                 "more states in its bank"));
  CHECK(mentions(message("\"offset\"", "\"ofset\""), "needs 'offset'"));
}
