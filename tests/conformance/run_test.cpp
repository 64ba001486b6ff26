#include <limits>

#include "dashpot/export/export_run.h"
#include "export/example_models.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kRunStep = 1e-3;

/// The forces and spreads of a run, sample by sample.
struct Forces {
  std::vector<double> force, spread;
};

Forces stepped(const DamperModel& model, const std::vector<DamperInput>& inputs) {
  Forces expected;
  std::vector<double> state(model.state_size());
  model.rest(inputs.front(), state);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    if (k > 0) model.advance(inputs[k - 1], inputs[k], kRunStep, state);
    expected.force.push_back(model.force(inputs[k], state));
    expected.spread.push_back(model.spread(inputs[k], state));
  }
  return expected;
}

void check_run(const DamperModel& model, const std::vector<DamperInput>& inputs) {
  const Forces expected = stepped(model, inputs);
  Forces got{std::vector<double>(inputs.size(), -1), std::vector<double>(inputs.size(), -1)};
  std::vector<double> state(model.state_size());
  model.rest(inputs.front(), state);
  CHECK(model.run(inputs, {.step = kRunStep}, state, {got.force.data(), got.spread.data()}) ==
        inputs.size());
  CHECK(got.force == expected.force);
  CHECK(got.spread == expected.spread);
}

/// As exported models, but without a lag, so that a law without states has none.
LawModel quick(const Law& law) {
  const LawModel lagging = example_law(law);
  return LawModel(law, lagging.parameters(), DriveUnit::Ampere, 0);
}

}  // namespace

TEST_CASE("a series of samples gives the bits that stepping gives, whatever the current does") {
  std::vector<DamperInput> moving = export_run({-0.02, 0.02, -0.3, 0.3, 0, 2}, kRunStep, 600);
  std::vector<DamperInput> held = moving;
  for (std::size_t k = 0; k < held.size(); ++k) held[k].current = k < 290 ? 0.5 : 1.5;
  for (const std::vector<DamperInput>* inputs : {&moving, &held}) {
    for (const ExampleModel& example : example_models()) {
      CAPTURE(example.name);
      check_run(*example.model, *inputs);
    }
    for (const Law* law : laws()) {
      CAPTURE(law->name);
      check_run(quick(*law), *inputs);
      std::vector<double> values;
      for (const ParamInfo& info : law->params) values.push_back(info.value);
      check_run(LawModel::constant(*law, values), *inputs);
    }
  }
}

TEST_CASE("a series ends before the first force that is no number") {
  std::vector<DamperInput> inputs(600, {0.001, 0.1, 1});
  std::vector<double> force(inputs.size());
  for (const char* name : {"bingham", "bouc_wen"})
    for (const std::size_t broken : {0, 1, 255, 256, 257, 599}) {
      const LawModel model = quick(find_law(name));
      std::vector<DamperInput> some = inputs;
      some[broken].velocity = std::numeric_limits<double>::quiet_NaN();
      std::vector<double> state(model.state_size());
      model.rest(inputs.front(), state);
      CAPTURE(name);
      CHECK(model.run(some, {.step = kRunStep}, state, {force.data()}) == broken);
    }
}
