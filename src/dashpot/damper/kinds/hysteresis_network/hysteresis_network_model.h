#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper/nets/gated_network.h"
#include "dashpot/damper/nets/hysteresis_bank.h"
#include "dashpot/damper/nets/stateful_ensemble.h"

namespace dashpot {

/// A bank of states and the network that reads it.
struct HysteresisNetwork {
  HysteresisBank bank;
  GatedNetwork network;

  const HysteresisBank& states() const noexcept { return bank; }
  /// Rates, weights of neurons and gates.
  std::size_t parameter_count() const noexcept { return bank.size() + network.parameter_count(); }
  double force(const DamperInput& input, std::span<const double> state) const noexcept {
    return read_by(network, bank, input, state);
  }
  Value to_json() const;
  void require_sound(const std::string& where) const;
};

/// Velocity and current -> force with hysteresis. Bounded by construction for bounded inputs: the
/// states are, and nothing feeds back.
class HysteresisNetworkModel final : public StatefulEnsemble<HysteresisNetwork> {
 public:
  /// Throws Error, beginning with `where` (the name when empty), when the parts do not fit
  /// together.
  HysteresisNetworkModel(std::string name, std::vector<HysteresisNetwork> members,
                         double offset = 0, const std::string& where = {})
      : StatefulEnsemble(std::move(name), std::move(members), offset, where) {}

  ModelKind kind() const override { return ModelKind::HysteresisNetwork; }
  std::unique_ptr<DamperModel> with_offset(double newton) const override {
    return std::make_unique<HysteresisNetworkModel>(name(), members(), offset() + newton);
  }
};

std::unique_ptr<HysteresisNetworkModel> hysteresis_network_model_from_json(const Value& value);

}  // namespace dashpot
