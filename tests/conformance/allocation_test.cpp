#include <cstdlib>
#include <new>

#include "conformance/laws.h"
#include "damper/inverse/inverses.h"
#include "damper/kinds/family/example_family.h"
#include "damper/kinds/narx/narx_example.h"
#include "damper/kinds/passive_hybrid/passive_hybrid_example.h"
#include "damper/kinds/passive_network/passive_network_example.h"
#include "damper/kinds/state_space/state_space_example.h"
#include "dashpot/damper/inverse/registry.h"
#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/nets/mlp_evaluator.h"
#include "support.h"

using namespace dashpot;

namespace {
thread_local std::size_t allocations = 0;
}

// Out of line: inlined, g++ takes malloc() and free() for mismatches.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* block = std::malloc(size ? size : 1)) return block;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size ? size : 1);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto line = static_cast<std::size_t>(alignment);
  if (void* block = std::aligned_alloc(line, (size / line + 1) * line)) return block;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace {

void check_stepping(const DamperModel& model) {
  std::vector<double> state(model.state_size());
  model.rest(sine(0), state);
  double sum = 0;
  const std::size_t before = allocations;
  for (int k = 0; k < 1000; ++k) {
    model.advance(sine(k * 1e-3, 1), sine((k + 1) * 1e-3, 0.5), 1e-3, state);
    sum += model.force(sine((k + 1) * 1e-3, 0.5), state) +
           model.spread(sine((k + 1) * 1e-3, 0.5), state);
  }
  CHECK(allocations == before);
  CHECK(std::isfinite(sum));
}

}  // namespace

TEST_CASE("stepping a law allocates nothing") {
  for_each_law([](const Law& law) {
    Dependence d;
    for (const ParamInfo& info : law.params) {
      d.forms.push_back(info.form);
      d.coefficients.emplace_back(coefficient_count(info.form), 0.0).front() = info.value;
      if (info.fit == Fit::Drive) d.coefficients.back() = {0, 1};
    }
    const LawModel model(law, d, DriveUnit::Ampere, 100);
    check_stepping(model);
    const std::size_t before = allocations;
    const std::vector<double> control(10);
    CHECK(allocations == before + 1);  // the counter counts
  });
}

TEST_CASE("stepping a hysteresis network allocates nothing") {
  HysteresisNetwork member;
  member.bank = {.path_rates = {60, 500}, .velocity_rates = {60}, .current_rates = {50}};
  member.network.signals.resize(5);
  member.network.currents = 1;
  member.network.initialise(3, 1);
  const HysteresisNetworkModel model("test", {member, member});
  check_stepping(model);
}

TEST_CASE("stepping a member of a family allocates nothing") {
  check_stepping(example_family(FamilyTarget::Residual));
  check_stepping(example_family_network());
}

TEST_CASE("stepping static networks allocates nothing") {
  Mlp mlp;
  mlp.layers = {2, 10, 1};
  mlp.input_mean = {0, 0};
  mlp.input_scale = {1, 1};
  initialise(mlp, 1);
  check_stepping(NetworkModel("test", {"velocity", "current"}, {mlp, mlp}));
}

TEST_CASE("stepping a state space allocates nothing") {
  check_stepping(StateSpaceModel("test", {example_state_space(1), example_state_space(2)}));
  check_stepping(PassiveNetworkModel("test", {example_passive_network(1)}));
}

TEST_CASE("stepping a network with fed-back forces allocates nothing") {
  const Regressors regressors = example_regressors();
  const Mlp mlp = example_narx_network(regressors);
  check_stepping(NarxModel("test", regressors, {mlp, mlp}));
}

TEST_CASE("stepping a hybrid allocates nothing") {
  check_stepping(example_passive_hybrid());
  for_each_law([](const Law& law) {
    std::vector<double> values;
    for (const ParamInfo& param : law.params) values.push_back(param.value);
    const HybridSource source{LawModel::constant(law, values), {{60, 500}, {60}, {50}}};
    const std::size_t motions = source.motions();
    GatedNetwork network;
    network.signals.resize(motions + 2);
    network.currents = 2;
    network.initialise(3, 1);
    check_stepping(HybridModel(
        source, {std::vector<double>(motions), std::vector<double>(motions * (motions + 1) / 2)},
        network));
  });
}

TEST_CASE("stepping a fuzzy model allocates nothing") {
  using Shape = Membership::Shape;
  const Sugeno sugeno{.inputs = {{}, {}, {}},
                      .memberships = {{Shape::Bell, 0}, {Shape::Gaussian, 1}, {Shape::Sigmoid, 2}},
                      .rules = {{0, 1}, {1, 2}},
                      .consequents = {1, 2, 3, 4, 5, 6, 7, 8}};
  const FuzzyModel model(
      "test", FuzzyInputs({"velocity", "velocity_change", "current"}, {0.01, 0.02}, "test"),
      sugeno);
  check_stepping(model);
}

TEST_CASE("an inverse's command allocates nothing" * doctest::test_suite("long")) {
  for (const InverseScheme& scheme : inverse_schemes()) {
    CAPTURE(std::string(scheme.name));
    const auto inverse = scheme.make(driven(find_law("bingham"), 100), {.lag_rate = 100});
    std::vector<double> state(inverse->state_size());
    inverse->rest(sine(0), state);
    double sum = 0;
    const std::size_t before = allocations;
    for (int k = 0; k < 1000; ++k) {
      const DamperInput now = sine(k * 1e-3);
      sum += inverse->command({800 * std::sin(0.02 * k), now.displacement, now.velocity, 0.4, 300},
                              state);
    }
    CHECK(allocations == before);
    CHECK(sum > 0);
  }
}

TEST_CASE("running a network, and the passes and steps of its training, allocate nothing") {
  Mlp mlp;
  mlp.layers = {2, 10, 20, 1};
  mlp.input_mean = {0, 0};
  mlp.input_scale = {1, 1};
  initialise(mlp, 1);
  const std::vector<float> inputs(400, 0.5F);
  std::vector<float> outputs(200);
  const MlpEvaluator<float> evaluator(mlp);
  PaddedNetwork<float> network(mlp, 20, simd_levels().back());
  AlignedVector<float> mean(network.size()), square(network.size());
  const std::size_t before = allocations;
  evaluator.evaluate(inputs, outputs);
  CHECK(std::abs(evaluator.evaluate(inputs.data()) - outputs[0]) < 1e-5F);
  network.forward(20);
  network.backward(20);
  network.update({.optimiser = Optimiser::Adam, .rate = 1e-3F, .epsilon = 1e-8F}, mean, square);
  CHECK(allocations == before);
  const AlignedVector<float> control(10);
  CHECK(allocations == before + 1);  // the counter counts these, too
}
