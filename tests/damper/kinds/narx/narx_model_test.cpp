#include "dashpot/damper/kinds/narx/narx_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dashpot/evaluate.h"
#include "narx_example.h"
#include "support.h"

using namespace dashpot;

namespace {

DamperInput motion(double t) {
  return {0.01 * std::sin(20 * t), 0.2 * std::cos(20 * t) + 0.05 * std::sin(71 * t),
          1 + std::sin(5 * t)};
}

/// A force that grows by 1.2 each step.
NarxModel unstable() {
  const Regressors regressors = Regressors::of({"velocity"}, 0, 1, 1e-3);
  Mlp mlp;
  mlp.layers = {2, 1};
  mlp.parameters = {1, 1.2, 0};
  mlp.input_mean = {0, 0};
  mlp.input_scale = {0.1, 100};
  mlp.output_scale = 100;
  return NarxModel("unstable", regressors, {mlp});
}

}  // namespace

TEST_CASE("at steps of its sample time a NARX model is the plain recursion, bit for bit") {
  const Regressors regressors = example_regressors();
  const std::vector<Mlp> members{example_narx_network(regressors, 1),
                                 example_narx_network(regressors, 2)};
  const NarxModel model("test", regressors, members, 3);
  std::vector<double> state(model.state_size());
  std::vector<DamperInput> u(8, {0, 0, motion(0).current});
  model.rest(motion(0), state);
  const double at_rest = model.force({0, 0, motion(0).current}, state);
  std::vector<std::vector<double>> forces(2, std::vector<double>(8));
  const std::vector<double> settled(state.end() - 6, state.end());  // three forces of each member
  for (std::size_t m = 0; m < 2; ++m) std::fill(forces[m].begin(), forces[m].end(), settled[3 * m]);
  CHECK(at_rest == (settled[0] + settled[3]) / 2 + 3);
  for (std::size_t k = 1; k < 500; ++k) {
    const double t = 5e-3 * static_cast<double>(k);
    model.advance(motion(t - 5e-3), motion(t), 5e-3, state);
    u.push_back(motion(t));
    const auto past = [&](std::size_t lag) { return u[u.size() - 1 - lag]; };
    for (std::size_t m = 0; m < 2; ++m) {
      std::vector<double>& f = forces[m];
      const double row[] = {past(0).velocity, past(1).velocity, past(3).velocity,
                            past(2).current,  f[f.size() - 1],  f[f.size() - 2]};
      f.push_back(MlpEvaluator<double>(members[m]).evaluate(row));
    }
    REQUIRE(model.force(motion(t), state) == (forces[0].back() + forces[1].back()) / 2 + 3);
  }
}

TEST_CASE("steps of any size meet the grid at the same forces where the inputs are linear") {
  const Regressors regressors = example_regressors();
  const NarxModel model("test", regressors, {example_narx_network(regressors)});
  const DamperInput from{0, -0.2, 0.5}, to{0, 0.3, 1.5};
  const auto at = [&](double t) {
    return DamperInput{0, from.velocity + t * (to.velocity - from.velocity), from.current + t};
  };
  std::vector<double> whole(model.state_size()), parts(whole), one(whole);
  model.rest(from, whole);
  model.rest(from, parts);
  model.rest(from, one);
  double t = 0;
  Random random(3);
  while (t < 1) {
    const double next = std::min(1.0, t + random.uniform(0, 0.02));
    model.advance(at(t), at(next), next - t, parts);
    t = next;
  }
  for (int k = 0; k < 200; ++k) model.advance(at(5e-3 * k), at(5e-3 * (k + 1)), 5e-3, whole);
  model.advance(from, to, 1, one);
  CHECK_CLOSE(model.force(to, parts), model.force(to, whole), 1e-9, 1e-6);
  CHECK_CLOSE(model.force(to, one), model.force(to, whole), 1e-9, 1e-6);
}

TEST_CASE("between two instants of the grid the force goes over from the one to the other") {
  const Regressors regressors = example_regressors();
  const NarxModel model("test", regressors, {example_narx_network(regressors)});
  std::vector<double> state(model.state_size());
  model.rest(motion(0), state);
  double before = model.force(motion(0), state), largest = 0, steepest = 0;
  for (int k = 1; k < 5000; ++k) {
    const double t = 1e-4 * k;
    model.advance(motion(t - 1e-4), motion(t), 1e-4, state);
    const double now = model.force(motion(t), state);
    if (k > 200) steepest = std::max(steepest, std::abs(now - before));
    largest = std::max(largest, std::abs(now));
    before = now;
  }
  CHECK(steepest < 0.02 * largest);  // a jump to the next force of the grid would be 50 times that
}

TEST_CASE("a force that runs away stands still at the range, and free run tells when") {
  const NarxModel model = unstable();
  std::vector<double> state(model.state_size());
  model.rest({}, state);
  CHECK_FALSE(model.has_diverged(state));
  std::vector<DamperInput> inputs(100);
  std::vector<double> time;
  for (std::size_t k = 0; k < inputs.size(); ++k) time.push_back(1e-3 * static_cast<double>(k));
  for (std::size_t k = 1; k < inputs.size(); ++k) inputs[k].velocity = 0.01;
  const FreeRun run = free_run(model, inputs, time);
  // Standardised: f(k) = 0.1 (1.2^k - 1) / 0.2 is above 10 from the 17th step on.
  REQUIRE(run.diverged_at);
  CHECK_CLOSE(*run.diverged_at, 17e-3, 1e-12, 0);
  for (std::size_t k = 1; k < inputs.size(); ++k)
    model.advance(inputs[k - 1], inputs[k], 1e-3, state);
  CHECK(model.has_diverged(state));
  CHECK(model.force(inputs.back(), state) == NarxModel::kRange * 100);
  model.rest({}, state);
  CHECK_FALSE(model.has_diverged(state));
}

TEST_CASE("whatever comes in, a NARX model gives a number") {
  const Regressors regressors = example_regressors();
  Mlp relu = example_narx_network(regressors);
  relu.activations = {Activation::Relu, Activation::Identity};
  for (const Mlp& mlp : {example_narx_network(regressors), relu}) {
    const NarxModel model("test", regressors, {mlp});
    for (const double odd : {kNaN, kInfinity, -kInfinity, 1e300, -1e300, 5e-324}) {
      std::vector<double> state(model.state_size());
      for (const bool from_rest : {true, false}) {
        model.rest(from_rest ? DamperInput{0, odd, odd} : DamperInput{}, state);
        model.advance({0, 0.1, 1}, {0, odd, odd}, 3e-3, state);
        CHECK(std::isfinite(model.force({0, odd, odd}, state)));
        for (const double dt : {5e-3, odd, 1e9, 1e-9}) {
          model.advance({0, odd, 1}, {0, 0.1, odd}, dt, state);
          CHECK(std::isfinite(model.force({0, 0.1, 1}, state)));
        }
      }
    }
  }
}

TEST_CASE("a network with a bounded output stays within it") {
  const Regressors regressors = example_regressors();
  Mlp mlp = example_narx_network(regressors);
  for (double& weight : mlp.parameters) weight *= 50;
  mlp.activations = {Activation::Relu, Activation::Tanh};
  const NarxModel model("test", regressors, {mlp});
  std::vector<double> state(model.state_size());
  model.rest({}, state);
  double largest = 0;
  for (int k = 1; k < 2000; ++k) {
    model.advance(motion(5e-3 * (k - 1)), motion(5e-3 * k), 5e-3, state);
    largest = std::max(largest, std::abs(model.force(motion(5e-3 * k), state) - mlp.output_mean));
  }
  CHECK(largest > 0.9 * mlp.output_scale);
  CHECK(largest <= mlp.output_scale);
  CHECK_FALSE(model.has_diverged(state));
}

TEST_CASE("whether a model can diverge follows from its weights") {
  const Regressors regressors = example_regressors();
  Mlp mlp = example_narx_network(regressors);
  const auto can_diverge = [&] { return NarxModel("test", regressors, {mlp}).can_diverge(); };
  CHECK(unstable().can_diverge());
  CHECK_FALSE(can_diverge());  // five neurons, weights of some 0.4
  mlp.parameters.back() = -9.9;
  CHECK(can_diverge());
  mlp.activations = {Activation::Tanh, Activation::Tanh};
  CHECK_FALSE(can_diverge());
  mlp = example_narx_network(regressors);
  mlp.activations = {Activation::Relu, Activation::Identity};
  CHECK(can_diverge());
}

TEST_CASE("a measured force in place of its own is what the next one comes from") {
  const NarxModel model = unstable();
  const auto moved = model.with_offset(30);
  std::vector<double> state(model.state_size());
  moved->rest({}, state);
  moved->observe(130, state);
  moved->advance({}, {}, 1e-3, state);
  CHECK(moved->force({}, state) == 1.2 * 100 + 30);
  CHECK(moved->feedback_step() == 1e-3);
}

TEST_CASE("a regressor network without feedback knows its past inputs only") {
  const Regressors regressors = Regressors::of({"velocity", "current"}, 2, 0, 1e-2);
  CHECK(regressors.count() == 6);
  const Mlp mlp = example_narx_network(regressors);
  const NarxModel model("test", regressors, {mlp});
  std::vector<double> state(model.state_size());
  model.rest({0, 0, 1}, state);
  for (int k = 1; k <= 5; ++k)
    model.advance({0, 0.1 * (k - 1), 1.0 * (k - 1)}, {0, 0.1 * k, 1.0 * k}, 1e-2, state);
  const double row[] = {0.5, 0.4, 0.3, 5, 4, 3};
  CHECK_CLOSE(model.force({0, 0.5, 5}, state), mlp.evaluate(row), 1e-12, 0);
  CHECK(model.feedback_step() == 0);
}

TEST_CASE("rows of regressors hold the lags in their order, then the measured forces") {
  const std::vector<DamperInput> inputs{{0, 1, 10}, {0, 2, 20}, {0, 3, 30}, {0, 4, 40}, {0, 5, 50}};
  CHECK(regressor_rows(example_regressors(), inputs, {100, 200, 300, 400, 500}) ==
        std::vector<double>{4, 3, 1, 20, 300, 200, 5, 4, 2, 30, 400, 300});
}

TEST_CASE("a NARX model's JSON keeps every bit, and one that does not fit together is refused") {
  const Regressors regressors = example_regressors();
  const NarxModel model("narx_one_sensor", regressors, {example_narx_network(regressors)}, 4.5);
  const std::string text = format_json(model.to_json(), false);
  const auto back = narx_model_from_json(parse_json(text, "m.json"));
  CHECK(format_json(back->to_json(), false) == text);
  const auto message = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    REQUIRE(at != std::string::npos);
    changed.replace(at, from.size(), to);
    return message_of([&] { narx_model_from_json(parse_json(changed, "m.json")); });
  };
  const auto mentions = [](const std::string& told, const char* part) {
    CAPTURE(told);
    return told.find(part) != std::string::npos;
  };
  CHECK(mentions(message("[0,1,3]", "[0,1]"), "the layers do not go from 5 inputs"));
  CHECK(mentions(message("[0,1,3]", "[0,1,3000]"), "at most 1000"));
  CHECK(mentions(message("[0,1,3]", "[0,1,-1]"), "write a whole number"));
  CHECK(mentions(message("\"feedback\":[1,2]", "\"feedback\":[0,2]"), "a lag of 0 steps"));
  CHECK(mentions(message("\"sample_time\":0.005", "\"sample_time\":0"),
                 "sample time is not a positive"));
  CHECK(mentions(message("\"velocity\"", "\"speed\""), "unknown network input 'speed'"));
  CHECK(mentions(message("\"lags\":[2]", "\"lags\":[]"), "has no lags"));
  CHECK(mentions(message("\"offset\"", "\"off\""), "needs 'offset'"));
  CHECK(message_of([&] { NarxModel("x", regressors, {}); }).find("has no members") !=
        std::string::npos);
}
