#include "conformance/laws.h"
#include "damper/kinds/family/example_family.h"
#include "damper/kinds/hysteresis_network/hysteresis_network_example.h"
#include "damper/kinds/narx/narx_example.h"
#include "damper/kinds/passive_hybrid/passive_hybrid_example.h"
#include "damper/kinds/passive_network/passive_network_example.h"
#include "damper/kinds/state_space/state_space_example.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"
#include "dashpot/damper/kinds/narx/narx_model.h"
#include "support.h"

using namespace dashpot;

namespace {

/// The rates are what a short step makes of the states, and the force is the force.
void check_flow(const DamperModel& model) {
  CAPTURE(model.name());
  REQUIRE(model.flows());
  std::vector<double> state(model.state_size()), rates(state.size());
  model.rest(sine(0, 0.5), state);
  constexpr double kStep = 1e-3, kShort = 1e-8;
  for (int k = 0; k < 300; ++k) {
    const DamperInput now = sine(k * kStep, 0.5 + 0.1 * std::sin(0.1 * k));
    if (k % 50 == 7) {
      const double force = model.force(now, state);
      CHECK_CLOSE(model.flow(now, state, rates), force, 1e-12, 1e-12);
      std::vector<double> later = state;
      model.advance(now, now, kShort, later);
      for (std::size_t z = 0; z < state.size(); ++z)
        CHECK_CLOSE(rates[z], (later[z] - state[z]) / kShort, 1e-3,
                    1e-6 * (1 + std::abs(state[z])) / kStep);
    }
    model.advance(now, sine((k + 1) * kStep, 0.5 + 0.1 * std::sin(0.1 * (k + 1))), kStep, state);
  }
}

LawModel lagging(const Law& law) {
  const LawModel model = LawModel::constant(law, defaults(law));
  return LawModel(law, model.parameters(), DriveUnit::Ampere, 190);
}

}  // namespace

TEST_CASE("rates of states are what a short step makes of them: every law, with a lagging coil") {
  for_each_law([](const Law& law) { check_flow(lagging(law)); });
}

TEST_CASE("rates of states are what a short step makes of them: networks, families, hybrids") {
  check_flow(
      HysteresisNetworkModel("bank", {example_hysteresis_network(), example_hysteresis_network()}));
  check_flow(StateSpaceModel("states", {example_state_space(1), example_state_space(2)}));
  check_flow(PassiveNetworkModel("springs", {example_passive_network(1)}));
  check_flow(example_passive_hybrid());
  check_flow(example_family(FamilyTarget::Residual));
  check_flow(example_family_network());
  const HybridSource source{lagging(find_law("modified_bouc_wen")), {{60, 500}, {60}, {50}}};
  const std::size_t motions = source.motions();
  GatedNetwork network;
  network.signals.resize(motions + 2);
  network.currents = 2;
  network.initialise(3, 1);
  check_flow(HybridModel(
      source, {std::vector<double>(motions), std::vector<double>(motions * (motions + 1) / 2)},
      network));
}

TEST_CASE("a model whose memory goes by its own clock does not flow") {
  const Regressors regressors = example_regressors();
  CHECK(!NarxModel("test", regressors, {example_narx_network(regressors)}).flows());
}
