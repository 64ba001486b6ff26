#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper/kinds/state_space/state_space_cell.h"
#include "dashpot/damper/nets/gated_network.h"
#include "dashpot/damper/nets/stateful_ensemble.h"

namespace dashpot {

/// States x' = f(x, v, i) and the network F = g(x, v, i) that reads them.
struct StateSpaceNetwork {
  StateSpaceCell cell;
  GatedNetwork network;

  const StateSpaceCell& states() const noexcept { return cell; }
  /// Rates, weights of neurons and feedback; weights of the reading network.
  std::size_t parameter_count() const noexcept {
    return cell.parameter_count() + network.parameter_count();
  }
  double force(const DamperInput& input, std::span<const double> state) const noexcept {
    return read_by(network, cell, input, state);
  }
  Value to_json() const;
  void require_sound(const std::string& where) const;
};

/// Velocity and current -> force through states that act back on themselves. Bounded by
/// construction for bounded inputs: the states are.
class StateSpaceModel final : public StatefulEnsemble<StateSpaceNetwork> {
 public:
  /// Throws Error, beginning with `where` (the name when empty), when the parts do not fit
  /// together.
  StateSpaceModel(std::string name, std::vector<StateSpaceNetwork> members, double offset = 0,
                  const std::string& where = {})
      : StatefulEnsemble(std::move(name), std::move(members), offset, where) {}

  ModelKind kind() const override { return ModelKind::StateSpace; }
  std::unique_ptr<DamperModel> with_offset(double newton) const override {
    return std::make_unique<StateSpaceModel>(name(), members(), offset() + newton);
  }
};

std::unique_ptr<StateSpaceModel> state_space_model_from_json(const Value& value);

}  // namespace dashpot
