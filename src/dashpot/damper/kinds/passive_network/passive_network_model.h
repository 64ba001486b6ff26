#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/damper/kinds/passive_network/passive_network.h"
#include "dashpot/damper/nets/stateful_ensemble.h"

namespace dashpot {

/// Motion and current -> force by dampers that cannot generate energy; nor can their mean.
class PassiveNetworkModel final : public StatefulEnsemble<PassiveNetwork> {
 public:
  /// Throws Error, beginning with `where` (the name when empty), when a member is not sound.
  PassiveNetworkModel(std::string name, std::vector<PassiveNetwork> members, double offset = 0,
                      const std::string& where = {})
      : StatefulEnsemble(std::move(name), std::move(members), offset, where) {}

  ModelKind kind() const override { return ModelKind::PassiveNetwork; }
  bool needs_displacement() const noexcept override;
  std::unique_ptr<DamperModel> with_offset(double newton) const override {
    return std::make_unique<PassiveNetworkModel>(name(), members(), offset() + newton);
  }

  /// What all members store on the mean, J; the offset's work is no part of it.
  double stored_energy(const DamperInput& input, std::span<const double> state) const noexcept;
};

std::unique_ptr<PassiveNetworkModel> passive_network_model_from_json(const Value& value);

}  // namespace dashpot
