#include "dashpot/damper/kinds/passive_network/energy_balance.h"

namespace dashpot {
namespace {

/// Powers at one instant, W: of the motion, then of what drains.
struct Powers {
  double work = 0;
  PassiveDrain drain;
};

Powers powers_of(const PassiveNetworkModel& model, const DamperInput& input,
                 std::span<const double> state) {
  Powers powers{.work = (model.force(input, state) - model.offset()) * input.velocity};
  const double share = 1 / static_cast<double>(model.members().size());
  for (const PassiveNetwork& member : model.members()) {
    const PassiveDrain drain = member.drain(input, state.first(member.size()));
    powers.drain.creep += share * drain.creep;
    powers.drain.friction += share * drain.friction;
    powers.drain.viscous += share * drain.viscous;
    powers.drain.inertia += share * drain.inertia;
    state = state.subspan(member.size());
  }
  return powers;
}

}  // namespace

EnergyBalance energy_balance(const PassiveNetworkModel& model, std::span<const double> time,
                             std::span<const DamperInput> inputs) {
  EnergyBalance balance;
  if (inputs.empty()) return balance;
  std::vector<double> state(model.state_size());
  model.rest(inputs[0], state);
  const double begin = model.stored_energy(inputs[0], state);

  // Each column grows by the mean of its powers at both ends of a step.
  Powers before = powers_of(model, inputs[0], state), now = before;
  const auto grow = [](std::vector<double>& column, double p, double q, double dt) {
    column.push_back(column.empty() ? 0 : column.back() + 0.5 * dt * (p + q));
  };
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const double dt = k > 0 ? time[k] - time[k - 1] : 0;
    if (k > 0) model.advance(inputs[k - 1], inputs[k], dt, state);
    now = powers_of(model, inputs[k], state);
    grow(balance.work, before.work, now.work, dt);
    grow(balance.creep, before.drain.creep, now.drain.creep, dt);
    grow(balance.friction, before.drain.friction, now.drain.friction, dt);
    grow(balance.viscous, before.drain.viscous, now.drain.viscous, dt);
    grow(balance.inertia, before.drain.inertia, now.drain.inertia, dt);
    balance.stored.push_back(model.stored_energy(inputs[k], state) - begin);
    before = now;
  }
  return balance;
}

}  // namespace dashpot
