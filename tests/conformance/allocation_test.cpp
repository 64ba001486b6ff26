#include <cstdlib>
#include <new>

#include "conformance/laws.h"
#include "damper/inverse/inverses.h"
#include "dashpot/damper/fuzzy/fuzzy_model.h"
#include "dashpot/damper/inverse/registry.h"
#include "dashpot/damper/neural/hysteresis_network.h"
#include "support.h"

using namespace dashpot;

namespace {
thread_local std::size_t allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* block = std::malloc(size ? size : 1)) return block;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size ? size : 1);
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

TEST_CASE("stepping a law allocates nothing") {
  for_each_law([](const Law& law) {
    Dependence d;
    for (const ParamInfo& info : law.params) {
      d.forms.push_back(info.form);
      d.coefficients.emplace_back(coefficient_count(info.form), 0.0).front() = info.value;
      if (info.fit == Fit::Drive) d.coefficients.back() = {0, 1};
    }
    const LawModel model(law, d, "A", 100);
    std::vector<double> state(model.state_size());
    model.rest(sine(0), state);
    double sum = 0;
    const std::size_t before = allocations;
    for (int k = 0; k < 1000; ++k) {
      model.advance(sine(k * 1e-3, 1), sine((k + 1) * 1e-3, 0.5), 1e-3, state);
      sum += model.force(sine((k + 1) * 1e-3, 0.5), state);
    }
    CHECK(allocations == before);
    CHECK(std::isfinite(sum));
    const std::vector<double> control(10);
    CHECK(allocations == before + 1);  // the counter counts
  });
}

TEST_CASE("stepping a state network allocates nothing") {
  BankNetwork member;
  member.bank = {.path_rates = {60, 500}, .velocity_rates = {60}, .current_rates = {50}};
  member.network.signals.resize(5);
  member.network.currents = 1;
  member.network.initialise(3, 1);
  const HysteresisNetwork model("test", {member, member});
  std::vector<double> state(model.state_size());
  model.rest(sine(0), state);
  double sum = 0;
  const std::size_t before = allocations;
  for (int k = 0; k < 1000; ++k) {
    model.advance(sine(k * 1e-3, 1), sine((k + 1) * 1e-3, 0.5), 1e-3, state);
    sum += model.force(sine((k + 1) * 1e-3, 0.5), state);
  }
  CHECK(allocations == before);
  CHECK(std::isfinite(sum));
}

TEST_CASE("stepping a fuzzy model allocates nothing") {
  using Shape = Membership::Shape;
  const Sugeno sugeno{.inputs = {{}, {}, {}},
                      .memberships = {{Shape::Bell, 0}, {Shape::Gaussian, 1}, {Shape::Sigmoid, 2}},
                      .rules = {{0, 1}, {1, 2}},
                      .consequents = {1, 2, 3, 4, 5, 6, 7, 8}};
  const FuzzyModel model(
      "test", FuzzyInputs({"velocity", "velocity_change", "current"}, {0.01, 0.02}, "test"), sugeno);
  std::vector<double> state(model.state_size());
  model.rest(sine(0), state);
  double sum = 0;
  const std::size_t before = allocations;
  for (int k = 0; k < 1000; ++k) {
    model.advance(sine(k * 1e-3, 1), sine((k + 1) * 1e-3, 0.5), 1e-3, state);
    sum += model.force(sine((k + 1) * 1e-3, 0.5), state);
  }
  CHECK(allocations == before);
  CHECK(std::isfinite(sum));
}

TEST_CASE("an inverse's command allocates nothing") {
  for (const InverseScheme& scheme : inverse_schemes()) {
    CAPTURE(std::string(scheme.name));
    const auto inverse = scheme.make(driven(find_law("bingham"), 100), {.lag_rate = 100});
    std::vector<double> state(inverse->state_size());
    inverse->rest(sine(0), state);
    double sum = 0;
    const std::size_t before = allocations;
    for (int k = 0; k < 1000; ++k) {
      const DamperInput now = sine(k * 1e-3);
      sum += inverse->command({800 * std::sin(0.02 * k), now.displacement, now.velocity, 0.4, 300}, state);
    }
    CHECK(allocations == before);
    CHECK(sum > 0);
  }
}
